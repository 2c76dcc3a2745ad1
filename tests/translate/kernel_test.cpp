// Control flow, functions, structs, arrays: kernels that are GLSL and C++ at once, translated on the one side and
// compiled by the host compiler on the other.
#include <doctest/doctest.h>

#include "harness.h"
#include "oracle.h"

namespace twinshade {
#define KERNEL(name, has_double, numbers)                                \
  extern const ShaderModule twinshade_module_kernel_##name;              \
  extern const ShaderEntry twinshade_entries_kernel_##name##_baseline[]; \
  extern const std::uint32_t twinshade_entry_count_kernel_##name##_baseline;
#include "kernel_cases.inc"
#undef KERNEL

namespace {

// Every pair of small integers, floats that compare in all ways.
constexpr std::uint32_t kCount = 512;
int input_a(std::uint32_t i) { return static_cast<int>(i % 8); }
int input_b(std::uint32_t i) { return static_cast<int>(i / 8 % 8); }
float input_x(std::uint32_t i) { return static_cast<float>((i * 2654435761u) >> 28) * 0.5f; }
float input_y(std::uint32_t i) { return static_cast<float>((i * 2246822519u) >> 28) * 0.375f; }

void check(const std::string& name, bool has_double, int numbers, const ShaderModule& module,
           const ShaderEntry* entries, std::uint32_t count) {
  Invocations in;
  in.count = kCount;
  in.input = [](const std::string& input, std::uint32_t, std::uint32_t i) {
    return input == "input_a"   ? input_a(i)
           : input == "input_b" ? input_b(i)
                                : static_cast<double>(input == "input_x" ? input_x(i) : input_y(i));
  };
  for (Number number : {Number::lanes4, Number::lanes8, Number::lanes16, Number::scalar, Number::float64}) {
    const bool wide = number == Number::float64;
    if ((wide && !has_double) || (numbers >> static_cast<int>(number) & 1) == 0) continue;
    const Answer answer = run_shader(module, entries, count, number, in);
    int shown = 0;
    for (std::uint32_t i = 0; i < kCount && shown < 5; ++i) {
      const auto expected = oracle(name, wide, input_a(i), input_b(i), input_x(i), input_y(i));
      for (std::size_t c = 0; c < 4; ++c) {
        const double got = answer.outputs.at("answer")[c][i];
        if (got == expected[c]) continue;
        ++shown;
        CHECK_MESSAGE(got == expected[c], name, " on ", number_name(number), ": invocation ", i, " (a ", input_a(i),
                      ", b ", input_b(i), ", x ", input_x(i), ", y ", input_y(i), ") component ", c);
      }
    }
    CHECK(shown == 0);
  }
}

}  // namespace

#define KERNEL(name, has_double, numbers)                                                                              \
  TEST_CASE("kernel " #name) {                                                                                         \
    check(#name, has_double != 0, numbers, twinshade_module_kernel_##name, twinshade_entries_kernel_##name##_baseline, \
          twinshade_entry_count_kernel_##name##_baseline);                                                             \
  }
#include "kernel_cases.inc"
#undef KERNEL

}  // namespace twinshade
