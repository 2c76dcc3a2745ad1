// x^y = 2^(y log2 x), the logarithm and its product with y as unevaluated sums of two floats (see log2.glsl).
//
// y = 0 gives 1 for every x but NaN; x = 0 gives 0 (y > 0) or infinity (y < 0); negative x NaN, whatever y != 0; infinite x and y as
// the limits say, 1^infinity = 1. Denormal x and y count as 0. Results below 2^-126 are 0.
#include "exact/exp2.glsl"
#include "exact/log2.glsl"

float exact_pow(float x, float y) {
  precise float infinity = intBitsToFloat(0x7f800000);
  precise float magnitude = abs(x);
  bool zero = magnitude < 1.17549435e-38;    // 2^-126
  bool normal = !zero && magnitude < infinity;
  vec2 logarithm = exact_log2_pair(normal ? magnitude : 1.0);

  // y log2 x = product + error
  precise float product = y * logarithm.x;
  precise float y_upper = exact_upper_half(y);
  precise float y_lower = y - y_upper;
  precise float l_upper = exact_upper_half(logarithm.x);
  precise float l_lower = logarithm.x - l_upper;
  precise float error = (((y_upper * l_upper - product) + y_upper * l_lower) + y_lower * l_upper) + y_lower * l_lower;
  error = error + y * logarithm.y;
  bool in_range = product > -127.0 && product < 128.5;
  product = in_range ? product : product > 0.0 ? 128.5 : product < 0.0 ? -127.0 : 0.0;
  error = in_range ? error : 0.0;
  precise float n = floor(product + 0.5);
  precise float r = (product - n) + error;
  precise float power = exact_exp2_scaled(n, r);

  // what the logarithm does not cover
  precise float at_limit = zero == (y > 0.0) ? 0.0 : infinity;  // x = 0 or infinite
  power = normal ? power : at_limit;
  power = x <= -1.17549435e-38 ? intBitsToFloat(0x7fc00000) : power;  // 2^-126
  power = abs(y) < 1.17549435e-38 ? 1.0 : power;                      // 2^-126
  precise float sum = x + y;
  return x != x || y != y ? sum : power;
}
