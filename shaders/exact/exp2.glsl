// 2^x from + - * and bit casts. 2^n 2^r with n = round(x), r in [-1/2, 1/2]; 2^r by a minimax polynomial (Remez exchange on the
// relative error), 2^n by adding n to the exponent. Range reduction as in Muller, Elementary Functions, 3rd ed., section 11.
//
// x >= 128, and what rounds to it, gives infinity; results below 2^-126, which would be denormal, are 0; NaN gives NaN.

// 2^n * 2^r for n in [-127, 129], |r| <= 0.51.
float exact_exp2_scaled(float n, float r) {
  precise float power = 1.0 + r * (0.693147182 + r * (0.240225941 + r * (0.0555036627 + r * (0.00962544512 +  // error 2^-26.2
                              r * (0.00133879273 + r * 0.000133324909)))));
  int bits = min(floatBitsToInt(power) + int(n) * 8388608, 0x7f800000);
  return bits < 0x00800000 ? 0.0 : intBitsToFloat(bits);
}

float exact_exp2(float x) {
  precise float limited = x < 128.5 ? x : 128.5;
  limited = limited > -127.0 ? limited : -127.0;
  precise float n = floor(limited + 0.5);
  precise float r = limited - n;
  float power = exact_exp2_scaled(n, r);
  return x != x ? x : power;
}
