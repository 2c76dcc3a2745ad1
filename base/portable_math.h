// Transcendental functions in double that return the same bits on every processor, compiler and C library: made of
// + - * / sqrt and bit operations only. Good to 1e-15 relative (absolute near zeros of sin and cos), checked by tests
// against long double. Used by scenes and lighting, and as the double counterparts of shaders/exact/.
#pragma once

namespace twinshade::portable {

inline constexpr double kPi = 3.14159265358979323846;

double sin(double x);  // any |x| < 2^30
double cos(double x);
double tan(double x);
double exp2(double x);
double exp(double x);
double log2(double x);  // log2(0) = -inf, negative: NaN
double log(double x);
double pow(double x, double y);  // exp2(y * log2(x)) in extended precision; x >= 0
double atan2(double y, double x);
double acos(double x);  // clamped to [-1, 1]
double asin(double x);

}  // namespace twinshade::portable
