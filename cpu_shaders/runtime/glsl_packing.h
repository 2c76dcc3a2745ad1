// GLSL 4.50 section 8.4: packing. Unpacking names its policy, glsl::unpackHalf2x16<N>(u), since an integer alone does
// not tell float from double. Halves round to nearest even, in software: FTZ does not touch their denormals.
#pragma once

#include "cpu_shaders/runtime/glsl_common.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace number {

inline std::uint32_t half_from_float(float f) {
  const std::uint32_t word = bits<std::uint32_t>(f), sign = word >> 16 & 0x8000u, magnitude = word & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return sign | 0x7e00u;   // NaN
  if (magnitude >= 0x477ff000u) return sign | 0x7c00u;  // 65520 and more: infinity
  const int exponent = static_cast<int>(magnitude >> 23) - 127;
  if (exponent < -25) return sign;
  std::uint32_t mantissa = magnitude & 0x7fffffu;
  int shift = 13;
  std::uint32_t base = static_cast<std::uint32_t>(exponent + 14) << 10;  // the hidden one adds the exponent's last step
  if (exponent < -14) {
    shift = -1 - exponent;
    base = 0;
  }
  mantissa |= 0x800000u;
  const std::uint32_t kept = mantissa >> shift, rest = mantissa & ((1u << shift) - 1), half = 1u << (shift - 1);
  return sign | (base + kept + (rest > half || (rest == half && (kept & 1u))));
}
inline float float_from_half(std::uint32_t h) {
  const std::uint32_t sign = (h & 0x8000u) << 16, exponent = h >> 10 & 31u, mantissa = h & 0x3ffu;
  if (exponent == 31) return bits<float>(sign | 0x7f800000u | mantissa << 13);
  if (exponent != 0) return bits<float>(sign | (exponent + 112) << 23 | mantissa << 13);
  return bits<float>(bits<std::uint32_t>(static_cast<float>(mantissa) * 0x1p-24f) | sign);
}

}  // namespace number

namespace glsl {

namespace packing {
// Each component to an integer field of `bits` bits; component 0 in the lowest.
template <Vec A, class F>
TWINSHADE_INLINE auto pack(const A& a, std::uint32_t bits, F field) {
  using U = typename A::element::template with<std::uint32_t>;
  U word(0u);
  for (int i = 0; i < A::size; ++i) {
    const U part = field(a[i]) & U((1u << bits) - 1);
    word = word | part << U(static_cast<std::uint32_t>(i) * bits);
  }
  return word;
}
template <Lane F>
TWINSHADE_INLINE auto to_field(const F& x, double low, double scale) {  // round(clamp(x, low, 1) * scale)
  const auto k = [&](double c) TWINSHADE_LAMBDA { return detail::constant_for(x, c); };
  return lanes_round_even(lanes_min(lanes_max(x, k(low)), k(1)) * k(scale))
      .template to<std::int32_t>()
      .template to<std::uint32_t>();
}
template <int n, Lane U, class F>
TWINSHADE_INLINE auto unpack(const U& word, std::uint32_t bits, F value) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    const auto field = [&](std::uint32_t i) TWINSHADE_LAMBDA { return (word >> U(i * bits)) & U((1u << bits) - 1); };
    using T = decltype(value(word));
    return vec<T, n>(value(field(k))...);
  }
  (detail::Indices<n>());
}
template <class N, Lane U>
TWINSHADE_INLINE auto from_unorm(const U& field, double scale) {
  const auto x = field.template to<typename N::real>();
  return x / detail::constant_for(x, scale);
}
template <class N, Lane U>
TWINSHADE_INLINE auto from_snorm(const U& field, int bits, double scale) {
  const U shift(static_cast<std::uint32_t>(32 - bits));
  const auto x = ((field << shift).template to<std::int32_t>() >> shift).template to<typename N::real>();
  const auto k = [&](double c) TWINSHADE_LAMBDA { return detail::constant_for(x, c); };
  return lanes_min(lanes_max(x / k(scale), k(-1)), k(1));
}
}  // namespace packing

template <Vec A>
TWINSHADE_INLINE auto packUnorm2x16(const A& a) {
  return packing::pack(a, 16, [](const auto& x) TWINSHADE_LAMBDA { return packing::to_field(x, 0, 65535); });
}
template <Vec A>
TWINSHADE_INLINE auto packSnorm2x16(const A& a) {
  return packing::pack(a, 16, [](const auto& x) TWINSHADE_LAMBDA { return packing::to_field(x, -1, 32767); });
}
template <Vec A>
TWINSHADE_INLINE auto packUnorm4x8(const A& a) {
  return packing::pack(a, 8, [](const auto& x) TWINSHADE_LAMBDA { return packing::to_field(x, 0, 255); });
}
template <Vec A>
TWINSHADE_INLINE auto packSnorm4x8(const A& a) {
  return packing::pack(a, 8, [](const auto& x) TWINSHADE_LAMBDA { return packing::to_field(x, -1, 127); });
}
template <Vec A>
TWINSHADE_INLINE auto packHalf2x16(const A& a) {
  return packing::pack(a, 16, [](const auto& x) TWINSHADE_LAMBDA {
    return map_lanes([](std::uint32_t w) TWINSHADE_LAMBDA { return number::half_from_float(number::bits<float>(w)); },
                     x.template as<std::uint32_t>());
  });
}
template <class N, Lane U>
TWINSHADE_INLINE auto unpackUnorm2x16(const U& word) {
  return packing::unpack<2>(word, 16, [](const U& x) TWINSHADE_LAMBDA { return packing::from_unorm<N>(x, 65535); });
}
template <class N, Lane U>
TWINSHADE_INLINE auto unpackSnorm2x16(const U& word) {
  return packing::unpack<2>(word, 16, [](const U& x) TWINSHADE_LAMBDA { return packing::from_snorm<N>(x, 16, 32767); });
}
template <class N, Lane U>
TWINSHADE_INLINE auto unpackUnorm4x8(const U& word) {
  return packing::unpack<4>(word, 8, [](const U& x) TWINSHADE_LAMBDA { return packing::from_unorm<N>(x, 255); });
}
template <class N, Lane U>
TWINSHADE_INLINE auto unpackSnorm4x8(const U& word) {
  return packing::unpack<4>(word, 8, [](const U& x) TWINSHADE_LAMBDA { return packing::from_snorm<N>(x, 8, 127); });
}
template <class N, Lane U>
TWINSHADE_INLINE auto unpackHalf2x16(const U& word) {
  return packing::unpack<2>(word, 16, [](const U& x) TWINSHADE_LAMBDA {
    return map_lanes([](std::uint32_t h)
                         TWINSHADE_LAMBDA { return number::bits<std::uint32_t>(number::float_from_half(h)); },
                     x)
        .template as<float>()
        .template to<typename N::real>();
  });
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
