// GLSL 4.50 section 8.8: integer functions.
#pragma once

#include "cpu_shaders/runtime/glsl_common.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace glsl {

namespace integer {
// f(uint) to int per lane: counts and positions.
template <class F, LaneOrVec A>
TWINSHADE_INLINE auto counted(F f, const A& a) {
  return map(
      [f](const auto& x) TWINSHADE_LAMBDA {
        return map_lanes([f](std::int32_t v) TWINSHADE_LAMBDA { return static_cast<std::int32_t>(f(v)); },
                         x.template to<std::int32_t>());
      },
      a);
}
// All bits of a field of `bits` at `offset`; widths of 0 and 32 included. As uint.
template <Lane I>
TWINSHADE_INLINE auto low_bits(const I& bits) {
  using U = typename I::template with<std::uint32_t>;
  const U n = bits.template to<std::uint32_t>();
  return select(n >= U(32u), U(~0u), (U(1u) << n) - U(1u));
}
}  // namespace integer

// offset and bits are taken from all lanes' own values; where offset + bits > 32 GLSL leaves the result undefined.
template <LaneOrVec A, Lane O, Lane N>
TWINSHADE_INLINE auto bitfieldExtract(const A& a, const O& offset, const N& bits) {
  return map(
      [&](const auto& x) TWINSHADE_LAMBDA {
        using E = typename std::remove_cvref_t<decltype(x)>::element;
        const auto field = (x.template to<std::uint32_t>() >> offset) & integer::low_bits(bits);
        if constexpr (std::same_as<E, std::uint32_t>) {
          return field;
        } else {  // the field's highest bit is the sign
          using T = std::remove_cvref_t<decltype(field)>;
          const auto sign = (integer::low_bits(bits) >> Plain<std::uint32_t, 1>(1u)) + T(1u);
          const auto extended = (field ^ sign) - sign;
          return select(bits == Plain<std::int32_t, 1>(0), T(0u), extended).template to<std::int32_t>();
        }
      },
      a);
}
template <LaneOrVec A, LaneOrVec B, Lane O, Lane N>
TWINSHADE_INLINE auto bitfieldInsert(const A& base, const B& insert, const O& offset, const N& bits) {
  return map(
      [&](const auto& x, const auto& y) TWINSHADE_LAMBDA {
        using E = typename std::remove_cvref_t<decltype(x)>::element;
        const auto field =
            select(bits == Plain<std::int32_t, 1>(0), Plain<std::uint32_t, 1>(0u), integer::low_bits(bits) << offset);
        const auto word =
            (x.template to<std::uint32_t>() & ~field) | ((y.template to<std::uint32_t>() << offset) & field);
        return word.template to<E>();
      },
      base, insert);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto bitfieldReverse(const A& a) {
  return map(
      [](const auto& x) TWINSHADE_LAMBDA {
        return map_lanes(
            [](auto v) TWINSHADE_LAMBDA {
              auto w = static_cast<std::uint32_t>(v);
              w = (w >> 1 & 0x55555555u) | (w & 0x55555555u) << 1;
              w = (w >> 2 & 0x33333333u) | (w & 0x33333333u) << 2;
              w = (w >> 4 & 0x0f0f0f0fu) | (w & 0x0f0f0f0fu) << 4;
              return static_cast<decltype(v)>(__builtin_bswap32(w));
            },
            x);
      },
      a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto bitCount(const A& a) {
  return integer::counted(
      [](std::int32_t v) TWINSHADE_LAMBDA { return __builtin_popcount(static_cast<std::uint32_t>(v)); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto findLSB(const A& a) {  // -1 where no bit is set
  return integer::counted(
      [](std::int32_t v) TWINSHADE_LAMBDA { return v == 0 ? -1 : __builtin_ctz(static_cast<std::uint32_t>(v)); }, a);
}
// The highest bit that differs from the sign for int, the highest set for uint; -1 where there is none.
template <LaneOrVec A>
TWINSHADE_INLINE auto findMSB(const A& a) {
  return map(
      [](const auto& x) TWINSHADE_LAMBDA {
        using E = typename std::remove_cvref_t<decltype(x)>::element;
        return integer::counted(
            [](std::int32_t v) TWINSHADE_LAMBDA {
              const auto w = static_cast<std::uint32_t>(std::same_as<E, std::int32_t> && v < 0 ? ~v : v);
              return w == 0 ? -1 : 31 - __builtin_clz(w);
            },
            x);
      },
      a);
}
template <LaneOrVec A, LaneOrVec B, class C>
TWINSHADE_INLINE auto uaddCarry(const A& a, const B& b, C& carry) {
  const auto sum = a + b;
  carry = to_uint(lessThan(sum, a));
  return sum;
}
template <LaneOrVec A, LaneOrVec B, class C>
TWINSHADE_INLINE auto usubBorrow(const A& a, const B& b, C& borrow) {
  borrow = to_uint(lessThan(a, b));
  return a - b;
}
namespace integer {
template <class Wide, LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto high_word(const A& a, const B& b) {
  return map(
      [](const auto& x, const auto& y) TWINSHADE_LAMBDA {
        using T = decltype(x * y);
        return map_lanes(
            [](auto v, auto w) TWINSHADE_LAMBDA {
              return static_cast<decltype(v)>((static_cast<Wide>(v) * static_cast<Wide>(w)) >> 32);
            },
            T(x), T(y));
      },
      a, b);
}
}  // namespace integer
template <LaneOrVec A, LaneOrVec B, class H, class L>
TWINSHADE_INLINE void umulExtended(const A& a, const B& b, H& high, L& low) {
  high = integer::high_word<std::uint64_t>(a, b);
  low = a * b;
}
template <LaneOrVec A, LaneOrVec B, class H, class L>
TWINSHADE_INLINE void imulExtended(const A& a, const B& b, H& high, L& low) {
  high = integer::high_word<std::int64_t>(a, b);
  low = a * b;
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
