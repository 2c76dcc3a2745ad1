// log2(x) from + - * / and bit casts. x = 2^e m with m in [sqrt(1/2), sqrt(2)); log2(m) = 2/ln2 atanh(s), s = (m - 1) / (m + 1),
// carried as an unevaluated sum of two floats (Dekker, A floating-point technique for extending the available precision, 1971).
// Products are split by masking the low half of a significand, so every partial product is exact without a fused multiply-add.
//
// 0 and denormal x (of either sign) give -infinity, negative x NaN, infinity infinity, NaN NaN.

// The upper 12 bits of the significand.
float exact_upper_half(float x) {
  return intBitsToFloat(floatBitsToInt(x) & 0xfffff000);
}

// log2(x) as x + y, |y| <= ulp(x) / 2, with a relative error of about 2^-31; x positive, normal and finite.
vec2 exact_log2_pair(float x) {
  int bits = floatBitsToInt(x);
  int e = (bits - 0x3f3504f3) >> 23;  // 0x3f3504f3: sqrt(1/2)
  precise float m = intBitsToFloat(bits - e * 8388608);

  // s + s_low = (m - 1) / (m + 1); s = s_upper + s_lower
  precise float f = m - 1.0;
  precise float d = m + 1.0;
  precise float d_low = m - (d - 1.0);
  precise float reciprocal = 1.0 / d;
  precise float s = f * reciprocal;
  precise float s_upper = exact_upper_half(s);
  precise float s_lower = s - s_upper;
  precise float d_upper = exact_upper_half(d);
  precise float d_lower = d - d_upper;
  precise float residual = (((f - s_upper * d_upper) - s_upper * d_lower) - s_lower * d_upper) - s_lower * d_lower;
  precise float s_low = (residual - s * d_low) * reciprocal;

  // factor + factor_low = log2(m) / s = 2/ln2 + s^2 series(s^2), a minimax polynomial whose first two terms are Taylor's
  precise float s2 = s * s;
  precise float s2_low = ((s_upper * s_upper - s2) + (s_upper * s_lower + s * s_low) * 2.0) + s_lower * s_lower;
  precise float rest = s2 * (0.577080190 + s2 * (0.411849886 + s2 * 0.337822020));  // error 2^-36.7
  precise float series = 0.961796701 + rest;                                        // 2/(3 ln2) = 0.961796701 - 7.03e-9
  precise float series_low = (rest - (series - 0.961796701)) - 7.02846181e-9;
  precise float term = s2 * series;
  precise float term_low = s2 * series_low + s2_low * series;
  precise float factor = 2.88539004 + term;                                         // 2/ln2 = 2.88539004 + 3.85e-8
  precise float factor_low = ((term - (factor - 2.88539004)) + 3.85192607e-8) + term_low;

  // high + low = (s + s_low) (factor + factor_low)
  precise float high = s * factor;
  precise float factor_upper = exact_upper_half(factor);
  precise float factor_lower = factor - factor_upper;
  precise float low = (((s_upper * factor_upper - high) + s_upper * factor_lower) + s_lower * factor_upper) + s_lower * factor_lower;
  low = low + (s * factor_low + s_low * factor);

  // e + high + low
  precise float exponent = float(e);
  precise float sum = exponent + high;
  precise float error = high - (sum - exponent);
  low = low + error;
  precise float result = sum + low;
  precise float result_low = low - (result - sum);
  return vec2(result, result_low);
}

float exact_log2(float x) {
  precise float magnitude = abs(x);
  precise float infinity = intBitsToFloat(0x7f800000);
  bool normal = magnitude >= 1.17549435e-38 && magnitude < infinity;  // 2^-126
  precise float logarithm = exact_log2_pair(normal ? magnitude : 1.0).x;
  logarithm = magnitude < 1.17549435e-38 ? -infinity : normal ? logarithm : magnitude;  // 2^-126
  return x <= -1.17549435e-38 ? intBitsToFloat(0x7fc00000) : logarithm;  // 2^-126
}
