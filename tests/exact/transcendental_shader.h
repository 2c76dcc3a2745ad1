// All transcendental functions of shaders/exact/ in one shader, chosen by an input, so that one compilation serves all
// tests.
#pragma once

#include "tests/exact/shader_rows.h"

namespace twinshade::test {

enum class Function { exp2 = 0, log2, pow, sin, cos, atan2, acos, asin, exp, log, tan, sinh, cosh, tanh };
inline constexpr int kFunctions = 14;

inline constexpr const char* kTranscendentalShader = R"(
#include "exact/acos.glsl"
#include "exact/atan2.glsl"
#include "exact/exp.glsl"
#include "exact/log.glsl"
#include "exact/pow.glsl"
#include "exact/sin_cos.glsl"
#include "exact/tan.glsl"

in float which;
in float x;
in float y;
layout(location = 0) out float value;

void main() {
  int function = int(which);
  if (function == 0) value = exact_exp2(x);
  else if (function == 1) value = exact_log2(x);
  else if (function == 2) value = exact_pow(x, y);
  else if (function == 3) value = exact_sin(x);
  else if (function == 4) value = exact_cos(x);
  else if (function == 5) value = exact_atan2(x, y);
  else if (function == 6) value = exact_acos(x);
  else if (function == 7) value = exact_asin(x);
  else if (function == 8) value = exact_exp(x);
  else if (function == 9) value = exact_log(x);
  else if (function == 10) value = exact_tan(x);
  else if (function == 11) value = exact_sinh(x);
  else if (function == 12) value = exact_cosh(x);
  else value = exact_tanh(x);
}
)";

// y is ignored by functions of one argument.
inline std::vector<float> evaluate(const RowShader& shader, Function function, const std::vector<float>& x,
                                   const std::vector<float>& y) {
  std::vector<float> inputs(x.size(), static_cast<float>(function));
  inputs.insert(inputs.end(), x.begin(), x.end());
  inputs.insert(inputs.end(), y.begin(), y.end());
  return shader.run(inputs, x.size());
}

}  // namespace twinshade::test
