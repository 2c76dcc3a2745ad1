// Generated programs on the CPU, with every number type, and on llvmpipe, bit for bit against the interpreter.
#include <doctest/doctest.h>

#include <glslang/SPIRV/spirv.hpp>

#include <iostream>

#include "base/error.h"
#include "cpu_shaders/load/load_batch.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/bind_table.h"
#include "evaluate/cpu_rows.h"
#include "tests/fuzz/differential.h"

using namespace twinshade;

namespace {

EvaluationTarget cpu(Number number) { return {Backend::cpu, number, Isa::baseline}; }

std::vector<EvaluationTarget> with_driver(std::vector<EvaluationTarget> targets) {
#if TWINSHADE_HAS_GL
  targets.push_back({Backend::egl, Number::scalar, {}});
#endif
  return targets;
}

void check(const fuzz::Tally& tally, std::uint64_t programs) {
  CHECK(tally.programs == programs);
  for (const std::string& line : tally.mistranslated) FAIL_CHECK(line);
  for (const std::string& line : tally.driver_differs) FAIL_CHECK(line);
}

// Of programs 1 to `count` translated with a bug in one operator: how many compute something else, or no longer end.
int caught(spv::Op first, spv::Op second, std::uint64_t count) {
  TranslateOptions planted;
  planted.planted_bug = {first, second};
  std::vector<Translation> translations;
  std::vector<std::string> cpp;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    translations.push_back(translate(fuzz::source_of(seed, fuzz::generate_program(seed)), planted));
    cpp.push_back(translations.back().cpp);
  }
  BatchOptions options;
  options.compile.numbers = 1u << static_cast<int>(Number::scalar);
  const std::vector<BatchModule> modules = load_batch(cpp, options);
  int wrong = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const fuzz::GeneratedProgram program = fuzz::generate_program(seed);
    const BatchModule& loaded = modules[seed - 1];
    REQUIRE_MESSAGE(loaded.module != nullptr, loaded.error);
    const std::vector<BoundRows> bound =
        bind_table(fuzz::source_of(seed, program), translations[seed - 1].reflection, fuzz::table_of(seed, program));
    REQUIRE(bound.size() == 1);
    CpuRows rows;
    try {
      rows = run_cpu_rows(*loaded.module, loaded.module->entries[0], bound[0]);
    } catch (const UserError&) {
      ++wrong;
      continue;
    }
    EvaluatedRows computed = fuzz::interpreted(seed, program);
    const EvaluatedRows expected = computed;
    computed.kept = rows.kept;
    std::size_t at = 0;
    for (Values& output : computed.outputs)
      for (std::uint32_t c = 0; c < output.type.components(); ++c)
        for (std::uint32_t row = 0; row < fuzz::kRows; ++row)
          output.bits[row * output.type.components() + c] = rows.bits[at++];
    wrong += !fuzz::first_difference(computed, expected).empty();
  }
  return wrong;
}

}  // namespace

TEST_CASE("generated programs: scalar, eight lanes and llvmpipe compute what they mean") {
  check(fuzz::compare_programs(1, 36, with_driver({cpu(Number::scalar), cpu(Number::lanes8)}), 18), 36);
}

TEST_CASE("generated programs: four and sixteen lanes compute what they mean") {
  check(fuzz::compare_programs(37, 4, {cpu(Number::lanes4), cpu(Number::lanes16)}, 4), 4);
}

TEST_CASE("a wrong translation of one operator is caught") {
  CHECK(caught(spv::OpISub, spv::OpIAdd, 6) > 0);
  CHECK(caught(spv::OpFMul, spv::OpFAdd, 6) > 0);
  CHECK(caught(spv::OpNop, spv::OpNop, 6) == 0);
}
