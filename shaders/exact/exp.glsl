// e^x = 2^n e^r with n = round(x / ln 2) and r = x - n ln 2, ln 2 in two parts whose first has few bits (Cody and Waite, Software
// Manual for the Elementary Functions, 1980); from it the hyperbolic functions.
#include "exact/exp2.glsl"

float exact_exp(float x) {
  precise float limited = x < 89.0 ? x : 89.0;
  limited = limited > -88.0 ? limited : -88.0;
  precise float n = floor(limited * 1.44269502 + 0.5);                        // 1 / ln 2
  precise float r = (limited - n * 0.693359375) + n * 2.12194442e-4;          // ln 2 = 0.693359375 - 2.12194440e-4
  precise float binary = r * 1.44269502;                                      // 1 / ln 2
  float power = exact_exp2_scaled(n, binary);
  return x != x ? x : power;
}

// (e^x - e^-x) / 2; below 1 Taylor's series, which does not cancel. Overflows where e^x does.
float exact_sinh(float x) {
  precise float magnitude = abs(x);
  precise float x2 = x * x;
  precise float series = x + x * x2 * (0.166666672 + x2 * (0.00833333377 + x2 * (0.000198412701 + x2 * (2.75573188e-6 +  // 1/3! ...
                         x2 * 2.50521079e-8))));
  precise float power = exact_exp(magnitude);
  precise float large = power * 0.5 - 0.5 / power;
  return magnitude < 1.0 ? series : x < 0.0 ? -large : large;
}

float exact_cosh(float x) {
  precise float power = exact_exp(abs(x));
  precise float value = power * 0.5 + 0.5 / power;
  return value;
}

float exact_tanh(float x) {
  precise float magnitude = abs(x);
  precise float small = exact_sinh(x) / exact_cosh(x);
  precise float power = exact_exp(magnitude);
  precise float inverse_square = 1.0 / (power * power);
  precise float large = 1.0 - (2.0 * inverse_square) / (1.0 + inverse_square);
  return magnitude < 1.0 ? small : x < 0.0 ? -large : large;
}
