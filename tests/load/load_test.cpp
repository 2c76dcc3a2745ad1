#include "cpu_shaders/load/load.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"
#include "tests/load/cache_fixture.h"

using namespace twinshade;

TEST_CASE("built-in techniques are found by what they say, not by what they are called") {
  for (const TechniqueInfo& technique : techniques())
    for (const CoefficientStorage storage :
         {CoefficientStorage::lightmap, CoefficientStorage::vertex, CoefficientStorage::volume}) {
      if (!can_read(technique, storage)) continue;
      // Of precomputed visibility only lightmaps are built in
      if (technique.weights != VisibilityWeights::none && storage != CoefficientStorage::lightmap) continue;
      ShaderSource source = technique_source(technique, storage);
      const ShaderModule* module = find_builtin_module(source);
      REQUIRE_MESSAGE(module != nullptr, source.name);
      CHECK(module->abi_version == kAbiVersion);
      CHECK(source_hash(source) == module->source_hash);
      bool has_lanes4 = false;
      for (std::uint32_t i = 0; i < module->entry_count; ++i) has_lanes4 |= module->entries[i].number == Number::lanes4;
      CHECK(has_lanes4);
      source.text += " ";
      CHECK(find_builtin_module(source) == nullptr);
    }
}

TEST_CASE("a shader compiled on demand is never contracted into fused multiply-adds") {
  shared_cache();
  // 1 + 2^-12 squared minus its rounded square: 2^-24 where a * b + c is fused, 0 where the product is rounded first.
  const double x = 1.0 + 0x1p-12, negative_square = -double(float(x * x));
  for (const Number number : {Number::scalar}) {
    const ShaderModule& module = load_module(small_shader("r = a.x * a.y + a.z;"), number);
    CHECK(run_module(module, number, {x, x, negative_square}, 1)[0] == 0.0);
  }
  // The compiler's own flags, for an instruction set that has the fused operation.
  if (machine_isa() >= Isa::avx2) {
    const std::string object =
        compile_shader(translate(small_shader("r = a.x * a.y + a.z;")).cpp, Isa::avx2, Number::lanes8);
    const std::string disassembly = "objdump -d " + object + " 2>/dev/null | grep -c vfmadd";
    if (std::system("objdump --version >/dev/null 2>&1") == 0)
      CHECK(std::system((disassembly + " >/dev/null").c_str()) != 0);
    else
      MESSAGE("objdump is missing: the fused instructions of the AVX2 object were not looked for");
  }
}

TEST_CASE("without a compiler the message says what to install, and built-in techniques still load") {
  shared_cache();
  const TestVariable path("PATH", "/nonexistent"), cxx("CXX", nullptr);
  const std::string message = message_of([] { load_module(small_shader("r = a.z;"), Number::scalar); });
  CHECK_MESSAGE(message.find("install") != std::string::npos, message);
  CHECK(message.find('\n') == std::string::npos);
  for (const TechniqueInfo& technique : techniques()) {
    if (!can_read(technique, CoefficientStorage::lightmap)) continue;
    const ShaderSource source = technique_source(technique, CoefficientStorage::lightmap);
    if (find_builtin_module(source)) CHECK_NOTHROW(load_module(source, Number::lanes4));
  }
}

TEST_CASE("an instruction set that the machine lacks is refused by name") {
  if (machine_isa() == Isa::avx512) {
    MESSAGE("this machine has every instruction set: nothing to refuse");
    return;
  }
  const std::string message = message_of([] { load_module(small_shader("r = a.x;"), Number::lanes16, Isa::avx512); });
  CHECK_MESSAGE(message.find("avx512") != std::string::npos, message);
}

TEST_CASE("TWINSHADE_ISA names what code runs on, up to what the processor has") {
  CHECK(isa_named(nullptr, Isa::avx2) == Isa::avx2);
  CHECK(isa_named("", Isa::avx512) == Isa::avx512);
  CHECK(isa_named("baseline", Isa::avx512) == Isa::baseline);
  CHECK(isa_named("avx2", Isa::avx2) == Isa::avx2);
  CHECK(message_of([] { isa_named("avx512", Isa::avx2); }) ==
        "TWINSHADE_ISA=avx512: this processor has no avx512; the best it has is avx2");
  CHECK(message_of([] { isa_named("sse9", Isa::avx2); }) == "TWINSHADE_ISA=sse9 is none of baseline, avx2, avx512");
}
