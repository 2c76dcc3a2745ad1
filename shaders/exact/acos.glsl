// acos(x) and asin(x) from + - * and sqrt. |x| <= 1/2: a minimax polynomial for asin (Remez exchange on the relative error);
// above: asin(x) = pi/2 - 2 asin(sqrt((1 - x)/2)), which loses nothing near 1. |x| > 1 and NaN give NaN.

// asin(s), s = sqrt(z) in [0, 1/2].
float exact_asin_small(float s, float z) {
  precise float angle = s + s * z * (0.166667521 + z * (0.0749530941 + z * (0.0454691537 + z * (0.0241847411 +  // error 2^-27.6
                        z * 0.0421583988))));
  return angle;
}

float exact_acos(float x) {
  precise float magnitude = abs(x);
  bool outer = magnitude > 0.5;
  precise float half_rest = (1.0 - magnitude) * 0.5;
  precise float z = outer ? half_rest : x * x;
  precise float root = sqrt(z);
  precise float angle = exact_asin_small(outer ? root : magnitude, z);
  bool negative = x < 0.0;
  precise float twice = angle * 2.0;
  precise float behind = 3.14159274 - (twice + 8.74227766e-8);  // pi = float(pi) - 8.74e-8
  precise float near_end = negative ? behind : twice;
  precise float signed_angle = negative ? -angle : angle;
  precise float near_middle = 1.57079637 - (signed_angle + 4.37113883e-8);           // pi/2 = float(pi/2) - 4.37e-8
  return outer ? near_end : near_middle;
}

float exact_asin(float x) {
  precise float magnitude = abs(x);
  bool outer = magnitude > 0.5;
  precise float half_rest = (1.0 - magnitude) * 0.5;
  precise float z = outer ? half_rest : x * x;
  precise float root = sqrt(z);
  precise float angle = exact_asin_small(outer ? root : magnitude, z);
  precise float near_end = 1.57079637 - (angle * 2.0 + 4.37113883e-8);  // pi/2 = float(pi/2) - 4.37e-8
  precise float value = outer ? near_end : angle;
  return x < 0.0 ? -value : value;
}
