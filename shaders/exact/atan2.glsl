// The angle of (x, y) in [-pi, pi], from + - * /. The first octant, halved at tan(pi/8) by atan(t) = pi/4 + atan((t - 1)/(t + 1)),
// a minimax polynomial (Remez exchange on the relative error), and the multiple of pi/4 in two parts.
//
// Takes the sign of y, -0 and denormals included, so it is odd in y; (0, 0) gives 0, two infinities a multiple of pi/4, NaN gives NaN.

float exact_atan2(float y, float x) {
  precise float width = abs(x);
  precise float height = abs(y);
  bool steep = height > width;
  precise float small = steep ? width : height;
  precise float large = steep ? height : width;
  precise float scale = large > 4.25352959e37 ? 0.25 : large < 7.88860905e-31 ? 1.26765060e30 : 1.0;  // 2^125, 2^-100, 2^100
  small *= scale;
  large *= scale;

  precise float threshold = large * 0.414213568;               // tan(pi/8)
  bool wide = small > threshold || small > 3.40282347e38;      // the largest float
  precise float numerator = wide ? small - large : small;
  precise float denominator = wide ? small + large : large;
  precise float ratio = numerator / denominator;
  precise float t = small < large ? ratio : 0.0;
  precise float t2 = t * t;
  precise float series = -0.333333164 + t2 * (0.199985281 + t2 * (-0.142443895 + t2 * (0.105991445 - t2 * 0.0608996004)));  // 2^-30.4
  precise float octant_angle = t + t * t2 * series;

  int eighths = wide ? 1 : steep ? 2 : 0;
  bool left = x < 0.0;
  precise float turned = steep != left ? -octant_angle : octant_angle;
  precise float multiple = float(left ? 4 - eighths : eighths);
  precise float angle = multiple * 0.785398006 + (multiple * 1.56958237e-7 + turned);  // pi/4: 22 bits, and the rest
  precise float sum = x + y;
  angle = x != x || y != y ? sum : angle;
  return floatBitsToInt(y) < 0 ? -angle : angle;
}
