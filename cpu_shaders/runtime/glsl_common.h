// GLSL 4.50 sections 8.3 and 8.7: common and vector relational functions, with the meaning that Mesa gives them (its
// NIR lowering, measured on llvmpipe): min and max return the other operand where one is NaN; fract is a - floor(a),
// mod a - b * floor(a / b), mix x * (1 - t) + y * t, fma two roundings, round to even.
#pragma once

#include "cpu_shaders/runtime/conversions.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace detail {
// A constant in the real type of x; uniform.
template <Lane T>
TWINSHADE_INLINE constexpr Plain<typename T::element, 1> constant_for(const T&, double x) {
  return Plain<typename T::element, 1>(static_cast<typename T::element>(x));
}
// 2^e in real type E, the exponent of a normal number.
template <class E, Lane I>
TWINSHADE_INLINE auto power_of_two(const I& e) {
  if constexpr (std::same_as<E, float>) {
    return ((e + I(127)) << I(23)).template as<float>();
  } else {
    typename I::template with<E> r;
    for (int i = 0; i < I::width; ++i)
      r.set_lane(i, number::bits<double>(static_cast<std::uint64_t>(e.lane(i) + 1023) << 52));
    return r;
  }
}
}  // namespace detail

namespace glsl {

template <LaneOrVec A>
TWINSHADE_INLINE auto abs(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_abs(x); }, a);
}
// 0 for zeros and NaN.
template <LaneOrVec A>
TWINSHADE_INLINE auto sign(const A& a) {
  return map(
      [](const auto& x) TWINSHADE_LAMBDA {
        using T = std::remove_cvref_t<decltype(x)>;
        using E = typename T::element;
        const T zero(E(0)), one(E(1)), minus_one(static_cast<E>(-1));
        return select(x > zero, one, select(x < zero, minus_one, zero));
      },
      a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto floor(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_floor(x); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto ceil(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_ceil(x); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto trunc(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_trunc(x); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto roundEven(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_round_even(x); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto round(const A& a) {
  return roundEven(a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto fract(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x - lanes_floor(x); }, a);
}
template <LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto mod(const A& a, const B& b) {
  return map([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x - y * lanes_floor(x / y); }, a, b);
}
// The fraction has the sign of x; whole is trunc(x).
template <LaneOrVec A, class W>
TWINSHADE_INLINE auto modf(const A& a, W& whole) {
  const auto t = trunc(a);
  whole = t;
  return a - t;
}

template <LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto min(const A& a, const B& b) {
  return map([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return lanes_min(x, y); }, a, b);
}
template <LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto max(const A& a, const B& b) {
  return map([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return lanes_max(x, y); }, a, b);
}
template <LaneOrVec A, LaneOrVec L, LaneOrVec H>
TWINSHADE_INLINE auto clamp(const A& a, const L& low, const H& high) {
  return min(max(a, low), high);
}
// t: real, or bool (true takes y).
template <LaneOrVec A, LaneOrVec B, LaneOrVec T>
TWINSHADE_INLINE auto mix(const A& a, const B& b, const T& t) {
  return map(
      [](const auto& x, const auto& y, const auto& w) TWINSHADE_LAMBDA {
        if constexpr (std::same_as<typename std::remove_cvref_t<decltype(w)>::element, bool>)
          return select(w, y, x);
        else
          return x * (detail::constant_for(w, 1) - w) + y * w;
      },
      a, b, t);
}
template <LaneOrVec Edge, LaneOrVec A>
TWINSHADE_INLINE auto step(const Edge& edge, const A& a) {
  return map([](const auto& e, const auto& x)
                 TWINSHADE_LAMBDA { return select(x >= e, detail::constant_for(x, 1), detail::constant_for(x, 0)); },
             edge, a);
}
template <LaneOrVec L, LaneOrVec H, LaneOrVec A>
TWINSHADE_INLINE auto smoothstep(const L& low, const H& high, const A& a) {
  return map(
      [](const auto& e0, const auto& e1, const auto& x) TWINSHADE_LAMBDA {
        const auto k = [&](double c) TWINSHADE_LAMBDA { return detail::constant_for(x, c); };
        const auto t = lanes_min(lanes_max((x - e0) / (e1 - e0), k(0)), k(1));
        return t * (t * (k(3) - k(2) * t));
      },
      low, high, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto isnan(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x != x; }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto isinf(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_abs(x) == detail::constant_for(x, __builtin_inf()); },
             a);
}
template <LaneOrVec A, LaneOrVec B, LaneOrVec C>
TWINSHADE_INLINE auto fma(const A& a, const B& b, const C& c) {
  return a * b + c;
}

template <LaneOrVec A>
TWINSHADE_INLINE auto floatBitsToInt(const A& a) {
  return float_as_int(a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto floatBitsToUint(const A& a) {
  return float_as_uint(a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto intBitsToFloat(const A& a) {
  return int_as_float(a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto uintBitsToFloat(const A& a) {
  return uint_as_float(a);
}

// x = result * 2^exponent, .5 <= |result| < 1; zeros, infinities and NaN are themselves with exponent 0.
template <LaneOrVec A, class I>
TWINSHADE_INLINE auto frexp(const A& a, I& exponent) {
  const auto finite = [](auto x) TWINSHADE_LAMBDA { return x != 0 && x - x == 0; };
  exponent = map(
      [&](const auto& x) TWINSHADE_LAMBDA {
        using T = std::remove_cvref_t<decltype(x)>;
        typename T::template with<std::int32_t> r(std::int32_t{0});
        for (int i = 0; i < T::width; ++i) {
          int e = 0;
          if (finite(x.lane(i))) (void)__builtin_frexp(static_cast<double>(x.lane(i)), &e);
          r.set_lane(i, e);
        }
        return r;
      },
      a);
  return map(
      [&](const auto& x) TWINSHADE_LAMBDA {
        return map_lanes(
            [&](auto v) TWINSHADE_LAMBDA {
              int e = 0;
              return finite(v) ? static_cast<decltype(v)>(__builtin_frexp(static_cast<double>(v), &e)) : v;
            },
            x);
      },
      a);
}
// x * 2^exponent by two factors, so that no result is lost on the way (Mesa's lowering).
template <LaneOrVec A, LaneOrVec I>
TWINSHADE_INLINE auto ldexp(const A& a, const I& exponent) {
  return map(
      [](const auto& x, const auto& e) TWINSHADE_LAMBDA {
        using E = typename std::remove_cvref_t<decltype(x)>::element;
        using Int = std::remove_cvref_t<decltype(e)>;
        constexpr int bias = std::same_as<E, float> ? 127 : 1023;
        const Int clamped = lanes_min(lanes_max(e, Int(static_cast<std::int32_t>(-2 * bias + 2))),
                                      Int(static_cast<std::int32_t>(2 * bias)));
        const Int first = clamped >> Int(1), second = clamped - first;
        return x * detail::power_of_two<E>(first) * detail::power_of_two<E>(second);
      },
      a, exponent);
}

// --- vector relational functions (on scalars too)

// clang-format off
#define TWINSHADE_RELATION(name, op)                                                     \
  template <LaneOrVec A, LaneOrVec B>                                                    \
  TWINSHADE_INLINE auto name(const A& a, const B& b) {                                   \
    return map([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x op y; }, a, b);               \
  }
TWINSHADE_RELATION(lessThan, <)
TWINSHADE_RELATION(lessThanEqual, <=)
TWINSHADE_RELATION(greaterThan, >)
TWINSHADE_RELATION(greaterThanEqual, >=)
TWINSHADE_RELATION(equal, ==)
TWINSHADE_RELATION(notEqual, !=)
#undef TWINSHADE_RELATION
// clang-format on

template <LaneOrVec A>
TWINSHADE_INLINE auto any(const A& a) {
  if constexpr (Vec<A>)
    return fold([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x | y; }, a);
  else
    return a;
}
template <LaneOrVec A>
TWINSHADE_INLINE auto all(const A& a) {
  if constexpr (Vec<A>)
    return fold([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x & y; }, a);
  else
    return a;
}
template <LaneOrVec A>
TWINSHADE_INLINE auto not_(const A& a) {
  return !a;
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
