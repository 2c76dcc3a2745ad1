#include "tests/fuzz/differential.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "base/error.h"
#include "cpu_shaders/runtime/denormals.h"
#include "cpu_shaders/translate/compile_glsl.h"
#include "tests/fuzz/spirv_interpreter.h"

namespace twinshade::fuzz {
namespace {

constexpr const char* kNumbers[] = {"4 lanes", "8 lanes", "16 lanes", "scalar", "float64"};

ValueType value_type(const GlslType& type) {
  return {type.base, static_cast<std::uint32_t>(type.columns), static_cast<std::uint32_t>(type.rows),
          type.is_array() ? static_cast<std::uint32_t>(type.dimensions[0]) : 0};
}

std::string name_of(const EvaluationTarget& target) {
  return target.backend == Backend::cpu ? kNumbers[static_cast<int>(target.number)] : backend_name(target.backend);
}

std::uint32_t comparable(std::uint32_t bits, Scalar scalar) {
  return scalar == Scalar::f32 && std::isnan(std::bit_cast<float>(bits)) ? 0x7fc00000u : bits;
}

}  // namespace

ShaderSource source_of(std::uint64_t seed, const GeneratedProgram& program) {
  const std::string name = "program" + std::to_string(seed);
  return resolve_shader(name, program.text, name + ".frag");
}

ValueTable table_of(std::uint64_t seed, const GeneratedProgram& program) {
  ValueTable table;
  table.rows = kRows;
  for (const Interface& input : program.inputs) {
    Values values{input.name, value_type(input.type), {}, {}};
    for (std::uint32_t row = 0; row < kRows; ++row)
      for (const std::uint32_t word : interface_value(seed, input, row)) values.bits.push_back(word);
    table.inputs.push_back(std::move(values));
  }
  for (const Interface& uniform : program.uniforms)
    table.uniforms.push_back({uniform.name, value_type(uniform.type), interface_value(seed, uniform, 0), {}});
  return table;
}

EvaluatedRows interpreted(std::uint64_t seed, const GeneratedProgram& program) {
  Interpreter interpreter(compile_glsl(source_of(seed, program)));
  EvaluatedRows rows;
  for (const Interface& output : program.outputs)
    rows.outputs.push_back({output.name, value_type(output.type), {}, {}});
  std::map<std::string, Words> values;
  for (const Interface& uniform : program.uniforms) values[uniform.name] = interface_value(seed, uniform, 0);
  const FlushDenormals flush;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (const Interface& input : program.inputs) values[input.name] = interface_value(seed, input, row);
    const Invocation invocation = interpreter.run(values);
    rows.kept.push_back(!invocation.discarded);
    for (Values& output : rows.outputs) {
      const Words words = invocation.discarded ? Words(output.type.components()) : invocation.outputs.at(output.name);
      output.bits.insert(output.bits.end(), words.begin(), words.end());
    }
  }
  return rows;
}

std::string first_difference(const EvaluatedRows& computed, const EvaluatedRows& expected) {
  for (std::size_t row = 0; row < expected.kept.size(); ++row) {
    if ((computed.kept.at(row) != 0) != (expected.kept[row] != 0))
      return fmt::format("row {}: {}", row, expected.kept[row] ? "discarded" : "not discarded");
    if (!expected.kept[row]) continue;
    for (const Values& wanted : expected.outputs) {
      const Values* got = find_values(computed.outputs, wanted.name);
      TWINSHADE_CHECK_EQ(got != nullptr, true);
      const std::uint32_t components = wanted.type.components();
      for (std::uint32_t c = 0; c < components; ++c) {
        const std::uint32_t a = got->bits[row * components + c], b = wanted.bits[row * components + c];
        if (comparable(a, wanted.type.scalar) != comparable(b, wanted.type.scalar))
          return fmt::format("row {}: {} is {:#010x} ({:a}), not {:#010x} ({:a})", row,
                             component_name(wanted.name, wanted.type, c), a, std::bit_cast<float>(a), b,
                             std::bit_cast<float>(b));
      }
    }
  }
  return "";
}

Tally compare_programs(std::uint64_t first, std::uint64_t count, const std::vector<EvaluationTarget>& targets,
                       std::size_t batch, const std::function<void(const Tally&)>& progress) {
  Tally tally;
  Evaluator evaluator;
  for (std::uint64_t from = first; from < first + count; from += batch) {
    const std::uint64_t until = std::min(from + batch, first + count);
    std::vector<ShaderSource> sources;
    for (std::uint64_t seed = from; seed < until; ++seed) sources.push_back(source_of(seed, generate_program(seed)));
    evaluator.prepare(sources, targets);
    for (std::uint64_t seed = from; seed < until; ++seed) {
      const GeneratedProgram program = generate_program(seed);
      const EvaluatedRows expected = interpreted(seed, program);
      for (const std::uint8_t kept : expected.kept) tally.discarded_rows += kept == 0;
      ++tally.programs;
      for (const EvaluationTarget& target : targets) {
        std::string difference;
        try {
          difference = first_difference(evaluator.run(sources[seed - from], table_of(seed, program), target), expected);
        } catch (const UserError& error) {
          difference = error.what();
        } catch (const BackendError& error) {
          difference = error.what();
        }
        ++tally.runs;
        if (!difference.empty())
          (target.backend == Backend::cpu ? tally.mistranslated : tally.driver_differs)
              .push_back(fmt::format("seed {} on {}: {}", seed, name_of(target), difference));
      }
    }
    evaluator.forget();
    if (progress) progress(tally);
  }
  return tally;
}

}  // namespace twinshade::fuzz
