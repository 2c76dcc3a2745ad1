// GLSL 4.50 sections 8.1 and 8.2: trigonometry and exponentials. They are outside the exact dialect: drivers differ
// from each other and from this by ULPs (Mesa: exp 10, pow 83, atan 347; asin and acos far more). Here each lane is
// computed in double by base/portable_math.h and rounded once, so that our own results are the same everywhere and
// depend on no libm. Arguments of sin, cos and tan from 2^30 on give NaN.
#pragma once

#include "base/portable_math.h"
#include "cpu_shaders/runtime/glsl_common.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace detail {

// f: double to double. Uniform arguments are computed once.
template <class F, LaneOrVec... A>
TWINSHADE_INLINE auto in_double(F f, const A&... a) {
  return map(
      [f](const auto&... x) TWINSHADE_LAMBDA {
        using T = std::remove_cvref_t<decltype((x + ...))>;
        return map_lanes(
            [f](auto... v) TWINSHADE_LAMBDA { return static_cast<typename T::element>(f(static_cast<double>(v)...)); },
            T(x)...);
      },
      a...);
}

// Hyperbolic functions by exponentials, by series where those cancel.
inline double sinh(double x) {
  const double a = x < 0 ? -x : x;
  if (a < 0.25) {  // x + x^3/3! + x^5/5! + ...
    const double z = x * x;
    return x + x * z * (1 / 6.0 + z * (1 / 120.0 + z * (1 / 5040.0 + z * (1 / 362880.0 + z / 39916800.0))));
  }
  // Halves first: e^x overflows before sinh does.
  const double half = portable::exp(a * 0.5), value = 0.5 * half * half - 0.5 / (half * half);
  return x < 0 ? -value : value;
}
inline double cosh(double x) {
  const double half = portable::exp((x < 0 ? -x : x) * 0.5);
  return 0.5 * half * half + 0.5 / (half * half);
}
inline double tanh(double x) {
  if (x != x) return x;
  const double a = x < 0 ? -x : x;
  if (a > 22) return x < 0 ? -1 : 1;
  return sinh(x) / cosh(x);
}
inline double log1p(double x) {  // W. Kahan: the rounding of 1 + x divided out
  const double u = 1 + x;
  if (u == 1) return x;
  if (u - u != 0) return portable::log(u);
  return portable::log(u) * (x / (u - 1));
}
// The value of an odd function at x, of which |x| has `value`. Zero is doubled, not passed on: converted to float it
// would become what x was converted from, by some compilers, and that may be a denormal that was to be flushed.
inline double odd(double x, double value) { return x < 0 ? -value : x == 0 ? x + x : value; }
inline double asinh(double x) {
  const double a = x < 0 ? -x : x;
  const double value =
      a > 0x1p+500 ? portable::log(a) + portable::log(2) : log1p(a + a * a / (1 + __builtin_sqrt(a * a + 1)));
  return odd(x, value);
}
inline double acosh(double x) {
  if (!(x >= 1)) return __builtin_nan("");
  if (x > 0x1p+500) return portable::log(x) + portable::log(2);
  const double t = x - 1;
  return log1p(t + __builtin_sqrt(2 * t + t * t));
}
inline double atanh(double x) {
  const double a = x < 0 ? -x : x;
  return odd(x, 0.5 * log1p(2 * a / (1 - a)));
}

}  // namespace detail

namespace glsl {

template <LaneOrVec A>
TWINSHADE_INLINE auto radians(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x * detail::constant_for(x, 0.017453292519943295); },
             a);  // pi / 180
}
template <LaneOrVec A>
TWINSHADE_INLINE auto degrees(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x * detail::constant_for(x, 57.295779513082321); },
             a);  // 180 / pi
}

// clang-format off
#define TWINSHADE_TRANSCENDENTAL(name, function)                                           \
  template <LaneOrVec A>                                                                   \
  TWINSHADE_INLINE auto name(const A& a) {                                                 \
    return detail::in_double([](double x) TWINSHADE_LAMBDA { return function(x); }, a);                     \
  }
TWINSHADE_TRANSCENDENTAL(sin, portable::sin)
TWINSHADE_TRANSCENDENTAL(cos, portable::cos)
TWINSHADE_TRANSCENDENTAL(tan, portable::tan)
TWINSHADE_TRANSCENDENTAL(asin, portable::asin)
TWINSHADE_TRANSCENDENTAL(acos, portable::acos)
TWINSHADE_TRANSCENDENTAL(exp, portable::exp)
TWINSHADE_TRANSCENDENTAL(exp2, portable::exp2)
TWINSHADE_TRANSCENDENTAL(log, portable::log)
TWINSHADE_TRANSCENDENTAL(log2, portable::log2)
TWINSHADE_TRANSCENDENTAL(sinh, detail::sinh)
TWINSHADE_TRANSCENDENTAL(cosh, detail::cosh)
TWINSHADE_TRANSCENDENTAL(tanh, detail::tanh)
TWINSHADE_TRANSCENDENTAL(asinh, detail::asinh)
TWINSHADE_TRANSCENDENTAL(acosh, detail::acosh)
TWINSHADE_TRANSCENDENTAL(atanh, detail::atanh)
#undef TWINSHADE_TRANSCENDENTAL
// clang-format on

template <LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto pow(const A& a, const B& b) {
  return detail::in_double([](double x, double y) TWINSHADE_LAMBDA { return portable::pow(x, y); }, a, b);
}
template <LaneOrVec Y, LaneOrVec X>
TWINSHADE_INLINE auto atan(const Y& y, const X& x) {
  return detail::in_double([](double v, double u) TWINSHADE_LAMBDA { return portable::atan2(v, u); }, y, x);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto atan(const A& a) {
  return detail::in_double([](double x) TWINSHADE_LAMBDA { return portable::atan2(x, 1); }, a);
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
