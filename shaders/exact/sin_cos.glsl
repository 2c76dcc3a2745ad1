// sin(x) and cos(x) of radians, for every finite x, from + - *, floor and integer operations.
//   |x| < 400: x - k pi/2 with pi/2 in three parts, products with the first two exact (Cody and Waite, Software Manual for the
//   Elementary Functions, 1980). Above: the bits of 2/pi that matter, as integers (Payne and Hanek, Radian reduction for
//   trigonometric functions, 1983). Then minimax polynomials on [-pi/4, pi/4] (Remez exchange on the relative error).
// Infinities and NaN give NaN; sin(-0) is 0.

struct ExactQuadrant {
  float angle;   // in [-pi/4, pi/4], a little more after rounding
  int quadrant;  // x = quadrant pi/2 + angle, up to whole turns
};

uint exact_multiply_high(uint a, uint b) {
  uint a_high = a >> 16;
  uint a_low = a & 0xffffu;
  uint b_high = b >> 16;
  uint b_low = b & 0xffffu;
  uint middle = a_low * b_high + ((a_low * b_low) >> 16);
  uint carry = a_high * b_low + (middle & 0xffffu);
  return a_high * b_high + (middle >> 16) + (carry >> 16);
}

// |x| >= 256: x = m 2^e; m times a 96-bit window of 2/pi, modulo 4 turns of pi/2, as fixed point with 2 + 62 bits.
ExactQuadrant exact_reduce_large(float x) {
  const uint two_over_pi[8] = uint[8](0x00000000u, 0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u,
                                      0x3c439041u, 0xfe5163abu);  // floor(2/pi 2^224), 32 zero bits before it
  uint bits = floatBitsToUint(x);
  uint m = (bits & 0x007fffffu) | 0x00800000u;
  int first = int((bits >> 23) & 255u) - 120;  // bit of the table that m multiplies to weight 2 in the product
  int word = first >> 5;
  int shift = first & 31;
  int complement = 31 - shift;
  uint w0 = (two_over_pi[word] << shift) | ((two_over_pi[word + 1] >> 1) >> complement);
  uint w1 = (two_over_pi[word + 1] << shift) | ((two_over_pi[word + 2] >> 1) >> complement);
  uint w2 = (two_over_pi[word + 2] << shift) | ((two_over_pi[word + 3] >> 1) >> complement);
  uint addend = m * w1;
  uint low = addend + exact_multiply_high(m, w2);
  uint high = m * w0 + exact_multiply_high(m, w1) + (low < addend ? 1u : 0u);

  // nearest multiple of pi/2, and the signed rest as a sum of integers that are exact in float
  int quadrant = int(high >> 30);
  uint rest_high = (high << 2) | (low >> 30);
  uint rest_low = low << 2;
  bool upper = (rest_high & 0x80000000u) != 0u;
  rest_high = upper ? ~rest_high : rest_high;
  rest_low = upper ? ~rest_low : rest_low;
  precise float part0 = float(int(rest_high >> 8)) * 5.96046448e-8;                                         // 2^-24
  precise float part1 = float(int(((rest_high & 255u) << 16) | (rest_low >> 16))) * 3.55271368e-15;        // 2^-48
  precise float part2 = float(int(rest_low & 0xffffu)) * 5.42101086e-20;                                   // 2^-64
  precise float turn = part0 + (part1 + part2);
  precise float angle = turn * 1.57079637 - turn * 4.37113883e-8;  // pi/2 = float(pi/2) - 4.37e-8
  ExactQuadrant result;
  bool negative = upper != ((bits & 0x80000000u) != 0u);
  quadrant = upper ? quadrant + 1 : quadrant;
  result.angle = negative ? -angle : angle;
  result.quadrant = (bits & 0x80000000u) != 0u ? -quadrant : quadrant;
  return result;
}

ExactQuadrant exact_reduce(float x) {
  precise float magnitude = abs(x);
  ExactQuadrant result;
  if (magnitude < 400.0) {
    precise float k = floor(x * 0.636619747 + 0.5);  // 2/pi
    precise float angle = ((x - k * 1.570770263671875) - k * 2.60630622506141663e-5) - k * 6.07710063e-11;  // pi/2 in three
    result.angle = angle;
    result.quadrant = int(k);
  } else {
    result = exact_reduce_large(x);
  }
  return result;
}

// sin(angle) for even quadrants, cos(angle) for odd ones, with the quadrant's sign.
float exact_sin_of_quadrant(float angle, int quadrant) {
  precise float r = angle;
  precise float r2 = r * r;
  precise float sine = r + r * r2 * (-0.166666552 + r2 * (0.00833218917 - r2 * 0.000195182845));              // error 2^-27.9
  precise float cosine = 1.0 - (r2 * 0.5 - r2 * r2 * (0.0416666456 - r2 * (0.00138873013 - r2 * 2.44306702e-5)));  // 2^-33.1
  precise float value = (quadrant & 1) != 0 ? cosine : sine;
  return (quadrant & 2) != 0 ? -value : value;
}

float exact_sin(float x) {
  ExactQuadrant reduced = exact_reduce(x);
  precise float value = exact_sin_of_quadrant(reduced.angle, reduced.quadrant);
  precise float not_finite = x - x;  // 0, or NaN
  return not_finite != 0.0 ? not_finite : value;
}

float exact_cos(float x) {
  ExactQuadrant reduced = exact_reduce(x);
  precise float value = exact_sin_of_quadrant(reduced.angle, reduced.quadrant + 1);
  precise float not_finite = x - x;  // 0, or NaN
  return not_finite != 0.0 ? not_finite : value;
}
