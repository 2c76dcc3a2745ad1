// One number at a time: what every lane type does to each of its lanes, with GLSL's meaning and no undefined behaviour.
// Integers wrap, shift counts are taken & 31, division by zero is defined (int 0, uint ~0, remainder ~0, as Mesa does),
// min and max return the other operand where one is NaN, conversions clamp.
#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "cpu_shaders/runtime/isa.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace number {

template <class E>
concept Real = std::floating_point<E>;
template <class E>
concept Integer = std::same_as<E, std::int32_t> || std::same_as<E, std::uint32_t>;
template <class E>
concept Element = Real<E> || Integer<E> || std::same_as<E, bool>;

template <class To, class From>
TWINSHADE_INLINE To bits(From x) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &x, sizeof to);
  return to;
}

template <Element E>
TWINSHADE_INLINE constexpr E add(E a, E b) {
  if constexpr (Integer<E>)
    return static_cast<E>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
  else
    return a + b;
}
template <Element E>
TWINSHADE_INLINE constexpr E subtract(E a, E b) {
  if constexpr (Integer<E>)
    return static_cast<E>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
  else
    return a - b;
}
template <Element E>
TWINSHADE_INLINE constexpr E multiply(E a, E b) {
  if constexpr (Integer<E>)
    return static_cast<E>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
  else
    return a * b;
}
template <Element E>
TWINSHADE_INLINE constexpr E negate(E a) {
  if constexpr (Integer<E>)
    return static_cast<E>(0u - static_cast<std::uint32_t>(a));
  else
    return -a;
}

// Real division by zero is IEEE's; the sanitizer for integer code would call it an error.
#if defined(__clang__)
#define TWINSHADE_IEEE_DIVISION __attribute__((no_sanitize("float-divide-by-zero")))
#else
#define TWINSHADE_IEEE_DIVISION
#endif
template <Element E>
TWINSHADE_IEEE_DIVISION TWINSHADE_INLINE constexpr E divide(E a, E b) {
  if constexpr (Real<E>) {
    return a / b;
  } else {
    if (b == 0) return std::is_signed_v<E> ? E{0} : static_cast<E>(~0u);
    if constexpr (std::is_signed_v<E>) {
      if (b == -1) return negate(a);  // INT_MIN / -1 wraps
    }
    return static_cast<E>(a / b);
  }
}
// Signed operands as well are divided as unsigned ones: GLSL leaves negative operands undefined, Mesa does this.
template <Integer E>
TWINSHADE_INLINE constexpr E remainder(E a, E b) {
  if (b == 0) return static_cast<E>(~0u);
  return static_cast<E>(static_cast<std::uint32_t>(a) % static_cast<std::uint32_t>(b));
}
template <Integer E>
TWINSHADE_INLINE constexpr E shift_left(E a, std::uint32_t count) {
  return static_cast<E>(static_cast<std::uint32_t>(a) << (count & 31u));
}
template <Integer E>
TWINSHADE_INLINE constexpr E shift_right(E a, std::uint32_t count) {  // arithmetic for int
  return static_cast<E>(a >> (count & 31u));
}

// A number times this comes back as arithmetic sees it: a denormal as zero where they are flushed. Compilers drop a
// multiplication by a 1 that they know.
template <Real E>
TWINSHADE_INLINE E unknown_one() {
  std::uint32_t one = 1;
  asm("" : "+r"(one));
  return static_cast<E>(one);
}

// Of 0 and -0 the second, of a number and NaN the number. Floats and doubles as MINPS and MAXPS, and llvmpipe with
// them, have it: denormals are zeros where they are flushed. By intrinsics, since a compiler may or may not make the
// instruction of a comparison and a selection, which passes denormals.
template <Element E>
TWINSHADE_INLINE constexpr E minimum(E a, E b) {
  if constexpr (Real<E>) {
    if (b != b) return a;
    if (!std::is_constant_evaluated()) {
#if defined(__SSE2__)
      if constexpr (sizeof(E) == 4) return _mm_cvtss_f32(_mm_min_ss(_mm_set_ss(a), _mm_set_ss(b)));
      if constexpr (sizeof(E) == 8) return _mm_cvtsd_f64(_mm_min_sd(_mm_set_sd(a), _mm_set_sd(b)));
#else
      return (a < b ? a : b) * unknown_one<E>();
#endif
    }
  }
  return a < b ? a : b;
}
template <Element E>
TWINSHADE_INLINE constexpr E maximum(E a, E b) {
  if constexpr (Real<E>) {
    if (b != b) return a;
    if (!std::is_constant_evaluated()) {
#if defined(__SSE2__)
      if constexpr (sizeof(E) == 4) return _mm_cvtss_f32(_mm_max_ss(_mm_set_ss(a), _mm_set_ss(b)));
      if constexpr (sizeof(E) == 8) return _mm_cvtsd_f64(_mm_max_sd(_mm_set_sd(a), _mm_set_sd(b)));
#else
      return (a > b ? a : b) * unknown_one<E>();
#endif
    }
  }
  return a > b ? a : b;
}

template <Real E>
TWINSHADE_INLINE E square_root(E x) {
  if constexpr (std::same_as<E, float>)
    return __builtin_sqrtf(x);
  else
    return __builtin_sqrt(x);
}
template <Real E>
TWINSHADE_INLINE E absolute(E x) {
  if constexpr (std::same_as<E, float>)
    return __builtin_fabsf(x);
  else
    return __builtin_fabs(x);
}
// Each is one instruction from x86-64-v2 and ARMv8 on, so that it obeys FTZ and DAZ as the lanes do.
template <Real E>
TWINSHADE_INLINE E round_down(E x) {
  if constexpr (std::same_as<E, float>)
    return __builtin_floorf(x);
  else
    return __builtin_floor(x);
}
template <Real E>
TWINSHADE_INLINE E round_up(E x) {
  if constexpr (std::same_as<E, float>)
    return __builtin_ceilf(x);
  else
    return __builtin_ceil(x);
}
template <Real E>
TWINSHADE_INLINE E round_to_zero(E x) {
  if constexpr (std::same_as<E, float>)
    return __builtin_truncf(x);
  else
    return __builtin_trunc(x);
}
template <Real E>
TWINSHADE_INLINE E round_to_even(E x) {  // the default rounding mode is never changed
  if constexpr (std::same_as<E, float>)
    return __builtin_rintf(x);
  else
    return __builtin_rint(x);
}

// An index brought into [0, count).
template <Integer E>
TWINSHADE_INLINE constexpr int clamp_index(E i, int count) {
  if constexpr (std::is_signed_v<E>)
    return i < 0 ? 0 : i < count ? i : count - 1;
  else
    return i < static_cast<std::uint32_t>(count) ? static_cast<int>(i) : count - 1;
}

// Value conversion. Real to integer: towards zero, clamped to the type's range, NaN gives 0.
template <Element To, Element From>
TWINSHADE_INLINE constexpr To convert(From x) {
  if constexpr (std::same_as<To, bool>) {
    return x != From{0};
  } else if constexpr (Real<From> && std::same_as<To, std::int32_t>) {
    if (!(x >= From(-2147483648.0))) return x != x ? 0 : INT32_MIN;
    return x < From(2147483648.0) ? static_cast<std::int32_t>(x) : INT32_MAX;
  } else if constexpr (Real<From> && std::same_as<To, std::uint32_t>) {
    if (!(x > From(0))) return 0;
    return x < From(4294967296.0) ? static_cast<std::uint32_t>(x) : UINT32_MAX;
  } else {
    return static_cast<To>(x);
  }
}

}  // namespace number
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
