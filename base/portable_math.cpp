// Logarithm and exponential go through double-double numbers (T. J. Dekker, A floating-point technique for extending
// the available precision, 1971), so that pow keeps its digits; sine and cosine reduce their argument by a split pi/2
// (W. Cody and W. Waite, Software manual for the elementary functions, 1980). The polynomials are Taylor series: each
// coefficient is its own closed form. No fused multiply-add, no table, nothing that a compiler or a processor may do in
// two ways.
#include "base/portable_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace twinshade::portable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// An unevaluated sum, |low| <= ulp(high) / 2.
struct Pair {
  double high, low;
};

// Exact a + b where |a| >= |b| or a = 0.
Pair fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Exact a + b.
Pair two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

// Exact a * b, |a|, |b| < 2^996 (Veltkamp's split in halves of 26 bits).
Pair two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2^27 + 1
  const double a_scaled = kSplit * a, b_scaled = kSplit * b;
  const double a_high = a_scaled - (a_scaled - a), b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high, b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

Pair add(Pair a, Pair b) {
  const Pair sum = two_sum(a.high, b.high);
  return fast_two_sum(sum.high, sum.low + (a.low + b.low));
}

Pair multiply(Pair a, Pair b) {
  const Pair product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

Pair divide(Pair a, Pair b) {
  const double quotient = a.high / b.high;
  const Pair back = two_product(quotient, b.high);
  const double rest = ((a.high - back.high) - back.low + a.low) - quotient * b.low;
  return fast_two_sum(quotient, rest / b.high);
}

constexpr Pair kLn2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};    // ln 2
constexpr Pair kLog2E = {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};  // 1 / ln 2
constexpr Pair kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

// Nearest integer, ties to even, |x| < 2^51.
double nearest(double x) {
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}

double power_of_two(int exponent) {  // -1022 to 1023
  return std::bit_cast<double>(std::uint64_t(exponent + 1023) << 52);
}

// sum of odd powers, x + x^3 / 3 + x^5 / 5 + ..., without its first term and without the factor x: atanh for z = x^2,
// atan for z = -x^2. `terms` of them.
double inverse_tangent_tail(double z, int terms) {
  double sum = 0;
  for (int k = terms; k >= 1; --k) sum = z * (1.0 / (2 * k + 1) + sum);
  return sum;
}

// log2(x) for finite x > 0, good to about 2^-95 + 2^-66 |log2 of the mantissa|.
Pair log2_pair(double x) {
  // x = 2^exponent * m, m in [sqrt(1/2), sqrt(2))
  int exponent = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    exponent = -54;
  }
  std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  exponent += int(bits >> 52) - 1023;
  bits = (bits & 0x000fffffffffffffu) | 0x3ff0000000000000u;
  double m = std::bit_cast<double>(bits);
  if (m >= 0x1.6a09e667f3bcdp+0) {  // sqrt(2)
    m *= 0.5;
    exponent += 1;
  }
  // ln m = 2 atanh s, s = (m - 1) / (m + 1), |s| < .1716: 2 s (1 + z/3 + z^2/5 + z^3/7 ...), z = s^2
  const Pair s = divide({m - 1, 0}, two_sum(m, 1));
  const Pair z = multiply(s, s);
  constexpr Pair kThird = {0x1.5555555555555p-2, 0x1.5555555555555p-56};   // 1/3
  constexpr Pair kFifth = {0x1.999999999999ap-3, -0x1.999999999999ap-57};  // 1/5
  double tail = 0;
  for (int k = 12; k >= 3; --k) tail = z.high * (1.0 / (2 * k + 1) + tail);
  Pair series = multiply(z, add(kFifth, {tail, 0}));
  series = multiply(z, add(kThird, series));
  const Pair ln = add(s, multiply(s, series));
  const Pair result = multiply({2 * ln.high, 2 * ln.low}, kLog2E);
  return add({double(exponent), 0}, result);
}

// 2^(x.high + x.low)
double exp2_pair(Pair x) {
  if (x.high >= 1024) return kInfinity;
  if (x.high < -1080) return 0;
  const double n = nearest(x.high);
  const Pair r = multiply(two_sum(x.high - n, x.low), kLn2);
  // e^r = 1 + r + r^2 (1/2! + r/3! + ...), |r| <= .3466
  double factorial = 1307674368000.0;  // 15!
  double series = 0;
  for (int k = 15; k >= 2; --k) {
    series = series * r.high + 1.0 / factorial;
    factorial /= k;
  }
  const Pair sum = fast_two_sum(1, r.high);
  const double value = sum.high + (sum.low + (r.low + r.high * r.high * series));
  // Two factors: 2^n alone may be outside the normal numbers.
  const int whole = int(n), half = whole / 2;
  return value * power_of_two(half) * power_of_two(whole - half);
}

struct Reduced {
  Pair angle;    // |angle| <= pi/4
  int quadrant;  // x = angle + quadrant * pi/2 (mod 2 pi)
};

// |x| < 2^30: quadrant * part is exact for the first three parts of 23 bits.
Reduced reduce(double x) {
  constexpr double kPart[4] = {0x1.921fb4p+0, 0x1.4442d0p-24, 0x1.846988p-48, 0x1.8cc51701b839ap-72};  // sum: pi/2
  const double n = nearest(x * (1 / kHalfPi.high));
  Pair angle = two_sum(x - n * kPart[0], -(n * kPart[1]));
  angle = add(angle, {-(n * kPart[2]), 0});
  angle = add(angle, {-(n * kPart[3]), 0});
  return {angle, int(std::int64_t(n) & 3)};
}

// x - x^3/3! + x^5/5! ..., |x| <= pi/4
double sine_kernel(Pair x) {
  const double z = x.high * x.high;
  double series = 0;
  double factorial = 121645100408832000.0;  // 19!
  for (int k = 19; k >= 3; k -= 2) {
    series = 1.0 / factorial - z * series;
    factorial /= double(k) * (k - 1);
  }
  return x.high + (x.low * (1 - 0.5 * z) - x.high * z * series);
}

// 1 - x^2/2! + x^4/4! ..., |x| <= pi/4
double cosine_kernel(Pair x) {
  const Pair square = two_product(x.high, x.high);
  const double z = square.high;
  double series = 0;
  double factorial = 6402373705728000.0;  // 18!
  for (int k = 18; k >= 4; k -= 2) {
    series = 1.0 / factorial - z * series;
    factorial /= double(k) * (k - 1);
  }
  const Pair head = fast_two_sum(1, -0.5 * z);
  return head.high + (head.low + (z * z * series - (0.5 * square.low + x.high * x.low)));
}

bool in_range(double x) { return x > -0x1p30 && x < 0x1p30; }

}  // namespace

double sin(double x) {
  if (!in_range(x)) return kNaN;
  if (x == 0) return x;
  const Reduced r = reduce(x);
  const double value = (r.quadrant & 1) ? cosine_kernel(r.angle) : sine_kernel(r.angle);
  return (r.quadrant & 2) ? -value : value;
}

double cos(double x) {
  if (!in_range(x)) return kNaN;
  const Reduced r = reduce(x);
  const double value = (r.quadrant & 1) ? sine_kernel(r.angle) : cosine_kernel(r.angle);
  return ((r.quadrant + 1) & 2) ? -value : value;
}

double tan(double x) {
  if (!in_range(x)) return kNaN;
  if (x == 0) return x;
  const Reduced r = reduce(x);
  const double sine = sine_kernel(r.angle), cosine = cosine_kernel(r.angle);
  return (r.quadrant & 1) ? -cosine / sine : sine / cosine;
}

double exp2(double x) {
  if (std::isnan(x)) return kNaN;
  return exp2_pair({x, 0});
}

double exp(double x) {
  if (std::isnan(x)) return kNaN;
  if (x > 710) return kInfinity;
  if (x < -750) return 0;
  return exp2_pair(multiply({x, 0}, kLog2E));
}

double log2(double x) {
  if (std::isnan(x) || x < 0) return kNaN;
  if (x == 0) return -kInfinity;
  if (x == kInfinity) return kInfinity;
  return log2_pair(x).high;
}

double log(double x) {
  if (std::isnan(x) || x < 0) return kNaN;
  if (x == 0) return -kInfinity;
  if (x == kInfinity) return kInfinity;
  return multiply(log2_pair(x), kLn2).high;
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y) || x < 0) return kNaN;
  if (x == 0) return y > 0 ? 0 : kInfinity;
  if (x == kInfinity) return y > 0 ? kInfinity : 0;
  if (std::isinf(y)) return (x > 1) == (y > 0) ? kInfinity : 0;
  const Pair logarithm = log2_pair(x);
  const double rough = logarithm.high * y;
  if (rough >= 1025) return kInfinity;
  if (rough < -1081) return 0;
  return exp2_pair(multiply(logarithm, {y, 0}));
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  double a = std::fabs(y), b = std::fabs(x);  // first quadrant
  if (a == kInfinity && b == kInfinity) a = b = 1;

  // angle = atan(smaller / larger) in [0, pi/4]
  const bool steep = a > b;
  double smaller = steep ? b : a, larger = steep ? a : b;
  Pair angle{0, 0};
  if (smaller > 0 && larger < kInfinity) {
    if (larger > 0x1p1000) smaller *= 0x1p-100, larger *= 0x1p-100;
    if (larger < 0x1p-900) smaller *= 0x1p100, larger *= 0x1p100;
    // atan(t) = atan(c) + atan((t - c) / (1 + t c)), c one of 0, 1/2, 1: the rest is at most 1/4
    Pair base{0, 0};
    double c = 0;
    if (smaller > 0.75 * larger) {
      base = {0.5 * kHalfPi.high, 0.5 * kHalfPi.low};  // atan(1)
      c = 1;
    } else if (smaller > 0.25 * larger) {
      base = {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56};  // atan(1/2)
      c = 0.5;
    }
    const double t = (smaller - c * larger) / (larger + c * smaller);
    angle = add(base, two_sum(t, t * inverse_tangent_tail(-(t * t), 16)));
  }
  if (steep) angle = add(kHalfPi, {-angle.high, -angle.low});
  if (std::signbit(x)) angle = add({2 * kHalfPi.high, 2 * kHalfPi.low}, {-angle.high, -angle.low});
  return std::signbit(y) ? -angle.high : angle.high;
}

double acos(double x) {
  if (std::isnan(x)) return kNaN;
  if (x > 1) x = 1;
  if (x < -1) x = -1;
  return atan2(std::sqrt((1 - x) * (1 + x)), x);
}

double asin(double x) {
  if (std::isnan(x)) return kNaN;
  if (x > 1) x = 1;
  if (x < -1) x = -1;
  return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

}  // namespace twinshade::portable
