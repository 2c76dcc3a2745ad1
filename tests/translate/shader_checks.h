// Running the shaders of shaders/ and checking what they gave.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "harness.h"

#define SHADER(name)                                                     \
  extern const ShaderModule twinshade_module_shader_##name;              \
  extern const ShaderEntry twinshade_entries_shader_##name##_baseline[]; \
  extern const std::uint32_t twinshade_entry_count_shader_##name##_baseline;

#define RUN(name, number, in)                                                            \
  run_shader(twinshade_module_shader_##name, twinshade_entries_shader_##name##_baseline, \
             twinshade_entry_count_shader_##name##_baseline, number, in)

namespace twinshade {

inline int small_a(std::uint32_t i) { return static_cast<int>(i % 8); }
inline int small_b(std::uint32_t i) { return static_cast<int>(i / 8 % 8); }

inline double small_integers(const std::string& name, std::uint32_t, std::uint32_t i) {
  return name == "a" ? small_a(i) : small_b(i);
}

inline constexpr Number kFloats[] = {Number::lanes4, Number::lanes8, Number::lanes16, Number::scalar};
inline constexpr Number kAll[] = {Number::lanes4, Number::lanes8, Number::lanes16, Number::scalar, Number::float64};

// One line a value: which shader, number, invocation, output and component.
inline void check_value(const Answer& answer, const char* output, std::size_t component, std::uint32_t i,
                        double expected, Number number, double tolerance = 0) {
  const double got = answer.outputs.at(output).at(component).at(i);
  if (std::fabs(got - expected) <= tolerance) return;
  CHECK_MESSAGE(got == expected, output, "[", component, "] of invocation ", i, " on ", number_name(number));
}

}  // namespace twinshade
