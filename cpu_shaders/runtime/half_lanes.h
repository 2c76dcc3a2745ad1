// Arithmetic of 16-bit floats (IEEE 754 binary16, the `half` of GPUs), emulated in lanes of float: every result is the
// float one rounded to the nearest half, to even where two are as near. That is what a half unit gives for + - * / and
// sqrt: a float has more than twice a half's digits, so rounding twice rounds as once. 65520 and more become infinity;
// denormal halves, down to 2^-24, are kept, also where those of floats are flushed: they are normal floats.
//
// Not part of runtime.h: translations of shaders that are to run in lower precision alone include it. All values lie in
// lanes of float; `in_half(f, a...)` is f with its operands rounded to half and every operation within in half,
// `of_halves(f, a...)` the same where the operands are halves already, `in_half_if` where a line is switched on.
#pragma once

#include "cpu_shaders/runtime/runtime.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// A function of its own: a shader has it after nearly every operation, and compilers take long over what is inlined.
template <Lane F>
TWINSHADE_APART F round_to_half(const F& x) {
  using U = typename F::template with<std::uint32_t>;
  const U word = x.template as<std::uint32_t>(), magnitude = word & U(0x7fffffffu), sign = word & U(0x80000000u);
  const F positive = magnitude.template as<float>();
  // Half the last place that is kept, less one where that place is even; carries into the exponent are right.
  const U odd = (magnitude >> U(13u)) & U(1u);
  const U rounded = (magnitude + U(0xfffu) + odd) & U(0xffffe000u);
  // From 2^-1 on floats are 2^-24 apart, as halves below 2^-14.
  const U small = ((positive + F(0.5f)) - F(0.5f)).template as<std::uint32_t>();
  U half = select(magnitude < U(0x38800000u), small, rounded);       // 2^-14
  half = select(magnitude >= U(0x477ff000u), U(0x7f800000u), half);  // 65520
  half = select(magnitude > U(0x7f800000u), magnitude, half);        // NaN
  return (half | sign).template as<float>();
}

// F: lanes of float, of which each is a half.
template <Lane F>
struct HalfLanes {
  using element = float;
  static constexpr int width = F::width;
  static constexpr bool is_lanes = true;
  using mask = typename F::mask;
  template <class G>
  using with = std::conditional_t<std::same_as<G, float>, HalfLanes, typename F::template with<G>>;

  F value;

  HalfLanes() = default;
  template <std::same_as<float> T>
  TWINSHADE_INLINE HalfLanes(T x) : value(round_to_half(F(x))) {}
  TWINSHADE_INLINE explicit HalfLanes(const F& x) : value(round_to_half(x)) {}
  template <Lane G>
  requires(G::width == 1 && F::width != 1 && std::same_as<typename G::element, float>) TWINSHADE_INLINE
      HalfLanes(const HalfLanes<G>& x)  // uniform to varying
      : value(x.value) {}
  // f: halves.
  static TWINSHADE_INLINE HalfLanes of(const F& f) {
    HalfLanes r;
    r.value = f;
    return r;
  }

  TWINSHADE_INLINE float lane(int i) const { return value.lane(i); }
  TWINSHADE_INLINE void set_lane(int i, float x) { value.set_lane(i, round_to_half(Plain<float, 1>(x)).e[0]); }
  template <class G>
  TWINSHADE_INLINE with<G> to() const {
    if constexpr (std::same_as<G, float>)
      return *this;
    else
      return value.template to<G>();
  }
  template <class G>
  TWINSHADE_INLINE auto as() const {  // the bits of the float
    return value.template as<G>();
  }
};

namespace detail {
template <class T>
inline constexpr bool is_half = false;
template <class F>
inline constexpr bool is_half<HalfLanes<F>> = true;
template <class T>
concept HalfOrReal = Lane<T> && std::same_as<typename T::element, float>;
template <class A, class B>
concept WithHalf = HalfOrReal<A> && HalfOrReal<B> &&(is_half<A> || is_half<B>);

// The float lanes of a half, or of what becomes one.
template <HalfOrReal T>
TWINSHADE_INLINE auto halves(const T& x) {
  if constexpr (is_half<T>)
    return x.value;
  else
    return round_to_half(x);
}
template <Lane F>
TWINSHADE_INLINE HalfLanes<F> as_half(const F& halves_already) {
  return HalfLanes<F>::of(halves_already);
}
}  // namespace detail

// clang-format off
#define TWINSHADE_HALF_OPERATOR(op)                                                       \
  template <class A, class B>                                                             \
    requires detail::WithHalf<A, B>                                                       \
  TWINSHADE_INLINE auto operator op(const A& a, const B& b) {                             \
    return detail::as_half(round_to_half(detail::halves(a) op detail::halves(b)));        \
  }
TWINSHADE_HALF_OPERATOR(+)
TWINSHADE_HALF_OPERATOR(-)
TWINSHADE_HALF_OPERATOR(*)
TWINSHADE_HALF_OPERATOR(/)
#undef TWINSHADE_HALF_OPERATOR

#define TWINSHADE_HALF_RELATION(op)                                                       \
  template <class A, class B>                                                             \
    requires detail::WithHalf<A, B>                                                       \
  TWINSHADE_INLINE auto operator op(const A& a, const B& b) {                             \
    return detail::halves(a) op detail::halves(b);                                        \
  }
TWINSHADE_HALF_RELATION(<)
TWINSHADE_HALF_RELATION(<=)
TWINSHADE_HALF_RELATION(>)
TWINSHADE_HALF_RELATION(>=)
TWINSHADE_HALF_RELATION(==)
TWINSHADE_HALF_RELATION(!=)
#undef TWINSHADE_HALF_RELATION

// Whose results are halves without rounding.
#define TWINSHADE_HALF_FUNCTION(function)                                                 \
  template <class F>                                                                      \
  TWINSHADE_INLINE HalfLanes<F> function(const HalfLanes<F>& a) {                         \
    return HalfLanes<F>::of(function(a.value));                                           \
  }
TWINSHADE_HALF_FUNCTION(lanes_abs)
TWINSHADE_HALF_FUNCTION(lanes_floor)
TWINSHADE_HALF_FUNCTION(lanes_ceil)
TWINSHADE_HALF_FUNCTION(lanes_trunc)
TWINSHADE_HALF_FUNCTION(lanes_round_even)
#undef TWINSHADE_HALF_FUNCTION

#define TWINSHADE_ROUNDED_FUNCTION(function)                                              \
  template <class F>                                                                      \
  TWINSHADE_INLINE HalfLanes<F> function(const HalfLanes<F>& a) {                         \
    return HalfLanes<F>(function(a.value));                                               \
  }
TWINSHADE_ROUNDED_FUNCTION(lanes_sqrt)
TWINSHADE_ROUNDED_FUNCTION(quad_dx)
TWINSHADE_ROUNDED_FUNCTION(quad_dy)
#undef TWINSHADE_ROUNDED_FUNCTION
// clang-format on

template <class F>
TWINSHADE_INLINE HalfLanes<F> operator-(const HalfLanes<F>& a) {
  return HalfLanes<F>::of(-a.value);
}
template <class A, class B>
requires detail::WithHalf<A, B> TWINSHADE_INLINE auto lanes_min(const A& a, const B& b) {
  using F = decltype(detail::halves(a) + detail::halves(b));
  return detail::as_half(lanes_min(F(detail::halves(a)), F(detail::halves(b))));
}
template <class A, class B>
requires detail::WithHalf<A, B> TWINSHADE_INLINE auto lanes_max(const A& a, const B& b) {
  using F = decltype(detail::halves(a) + detail::halves(b));
  return detail::as_half(lanes_max(F(detail::halves(a)), F(detail::halves(b))));
}
template <Lane M, class A, class B>
requires detail::WithHalf<A, B> TWINSHADE_INLINE auto select(const M& m, const A& a, const B& b) {
  using F = decltype(detail::halves(a) + detail::halves(b));
  return detail::as_half(select(m, F(detail::halves(a)), F(detail::halves(b))));
}
template <class F, class Function, class... A>
TWINSHADE_INLINE HalfLanes<F> map_lanes(Function f, const HalfLanes<F>& first, const A&... rest) {
  return HalfLanes<F>(map_lanes(f, first.value, rest.value...));
}

namespace detail {

// f on each lane of float within a value; other values as they are.
template <class Function, class T>
TWINSHADE_INLINE auto each_real(Function f, const T& x) {
  if constexpr (Lane<T>) {
    if constexpr (std::same_as<typename T::element, float>)
      return f(x);
    else
      return x;
  } else if constexpr (Vec<T>) {
    return map([f](const auto& y) TWINSHADE_LAMBDA { return each_real(f, y); }, x);
  } else if constexpr (Mat<T>) {
    using R = decltype(each_real(f, x.c[0].x));
    mat<R, T::column_count, T::row_count> r;
    for (int i = 0; i < T::column_count; ++i) r.c[i] = each_real(f, x.c[i]);
    return r;
  } else if constexpr (Arr<T>) {
    using R = decltype(each_real(f, x.e[0]));
    arr<R, T::size> r;
    for (int i = 0; i < T::size; ++i) r.e[i] = each_real(f, x.e[i]);
    return r;
  } else {
    return x;
  }
}

}  // namespace detail

// A value rounded to half: scalar, vector, matrix or array; integers, booleans, structs and samplers pass.
template <class T>
TWINSHADE_INLINE auto to_half(const T& x) {
  return detail::each_real([](const auto& lanes) TWINSHADE_LAMBDA { return round_to_half(lanes); }, x);
}

// f(a...) in half, of numbers that are halves. Results are lanes of float again.
template <class Function, class... A>
TWINSHADE_INLINE auto of_halves(Function f, const A&... a) {
  return detail::each_real(
      [](const auto& lanes) TWINSHADE_LAMBDA { return detail::halves(lanes); },
      f(detail::each_real([](const auto& lanes) TWINSHADE_LAMBDA { return detail::as_half(lanes); }, a)...));
}
// Of any numbers: they are rounded first.
template <class Function, class... A>
TWINSHADE_INLINE auto in_half(Function f, const A&... a) {
  return of_halves(f, to_half(a)...);
}

// By line: the switches, which are the uniforms from `own` on, behind the shader's own.
TWINSHADE_INLINE const std::uint32_t* half_switches(const BufferView& own) {
  return reinterpret_cast<const std::uint32_t*>(own.bytes + own.size);
}
TWINSHADE_INLINE bool half_here(const std::uint32_t* switches, int line) { return switches[line] != 0; }
template <class T>
TWINSHADE_INLINE T to_half_if(bool half, T x) {
  if (half) x = to_half(x);
  return x;
}
template <class Function, class... A>
TWINSHADE_INLINE auto in_half_if(bool half, Function f, const A&... a) {
  auto result = f(a...);
  if (half) result = in_half(f, a...);
  return result;
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
