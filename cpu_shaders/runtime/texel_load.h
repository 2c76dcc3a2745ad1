// RGBA texels for each lane: one 16-byte load a lane and 4 x 4 transposes, which beats four gathers by far.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace registers {

// at: in twos of floats.
TWINSHADE_INLINE Float4 load_texel(const float* texels, std::uint32_t at) {
  Float4 r;
  std::memcpy(&r, texels + std::size_t{at} * 2, sizeof r);
  return r;
}

// rows[j]: texel j of each group of four lanes, one group per 128 bits; becomes channel c of all lanes.
template <class V>
TWINSHADE_INLINE void transpose_groups(V (&rows)[4]) {
  constexpr int W = sizeof(V) / 4;
  const auto shuffle = [&]<int... k>(const V& a, const V& b, auto pick, std::integer_sequence<int, k...>)
      TWINSHADE_LAMBDA {
    return __builtin_shufflevector(a, b, pick(k)...);
  };
  constexpr auto all = std::make_integer_sequence<int, W>();
  // pick(k): lane k of the result, numbers from W on being the second operand's.
  constexpr auto low = [](int k) TWINSHADE_LAMBDA { return k / 4 * 4 + k % 4 / 2 + (k % 2 ? W : 0); };
  constexpr auto high = [](int k) TWINSHADE_LAMBDA { return k / 4 * 4 + 2 + k % 4 / 2 + (k % 2 ? W : 0); };
  constexpr auto low_pairs = [](int k) TWINSHADE_LAMBDA { return k / 4 * 4 + k % 2 + (k % 4 / 2 ? W : 0); };
  constexpr auto high_pairs = [](int k) TWINSHADE_LAMBDA { return k / 4 * 4 + 2 + k % 2 + (k % 4 / 2 ? W : 0); };
  const V a = shuffle(rows[0], rows[1], low, all), b = shuffle(rows[2], rows[3], low, all);
  const V c = shuffle(rows[0], rows[1], high, all), d = shuffle(rows[2], rows[3], high, all);
  rows[0] = shuffle(a, b, low_pairs, all);
  rows[1] = shuffle(a, b, high_pairs, all);
  rows[2] = shuffle(c, d, low_pairs, all);
  rows[3] = shuffle(c, d, high_pairs, all);
}

template <class V>
TWINSHADE_INLINE auto concatenate(const V& a, const V& b) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(a, b, k...);
  }
  (std::make_integer_sequence<int, 2 * sizeof(V) / 4>());
}

// rows[j] of transpose_groups: load(i) is what lane i reads, 16 bytes.
template <int W, class Load>
TWINSHADE_INLINE Register<float, W> texel_row(Load load, int j) {
  if constexpr (W == 4)
    return load(j);
  else if constexpr (W == 8)
    return concatenate(load(j), load(j + 4));
  else
    return concatenate(concatenate(load(j), load(j + 4)), concatenate(load(j + 8), load(j + 12)));
}

}  // namespace registers

namespace detail {

// load(i): the four floats of lane i, a Float4. Result: four channels.
template <int W, class Load>
TWINSHADE_INLINE vec<Simd<float, W>, 4> transposed_texels(Load load) {
  vec<Simd<float, W>, 4> rgba;
  if constexpr (Simd<float, W>::whole) {
    Register<float, W> rows[4] = {registers::texel_row<W>(load, 0), registers::texel_row<W>(load, 1),
                                  registers::texel_row<W>(load, 2), registers::texel_row<W>(load, 3)};
    registers::transpose_groups(rows);
    rgba.x.v = rows[0];
    rgba.y.v = rows[1];
    rgba.z.v = rows[2];
    rgba.w.v = rows[3];
  } else {
    const auto low = transposed_texels<W / 2>(load);
    const auto high = transposed_texels<W / 2>([&](int i) TWINSHADE_LAMBDA { return load(i + W / 2); });
    rgba.x.lo = low.x, rgba.y.lo = low.y, rgba.z.lo = low.z, rgba.w.lo = low.w;
    rgba.x.hi = high.x, rgba.y.hi = high.y, rgba.z.hi = high.z, rgba.w.hi = high.w;
  }
  return rgba;
}

}  // namespace detail

// Texel texels[2 * index ...] of each lane; indices in range.
template <class Real, int W>
TWINSHADE_INLINE vec<Simd<float, W>, 4> load_texels(const float* texels, const Simd<std::uint32_t, W>& index) {
  static_assert(std::same_as<Real, float>);
  std::uint32_t at[W];
  index.store(at);
  return detail::transposed_texels<W>([&](int i) TWINSHADE_LAMBDA { return registers::load_texel(texels, at[i]); });
}
template <class Real, int W>
TWINSHADE_INLINE vec<Plain<Real, W>, 4> load_texels(const float* texels, const Plain<std::uint32_t, W>& index) {
  vec<Plain<Real, W>, 4> rgba;
  for (int i = 0; i < W; ++i) {
    const float* const texel = texels + std::size_t{index.e[i]} * 2;
    rgba.x.e[i] = texel[0];
    rgba.y.e[i] = texel[1];
    rgba.z.e[i] = texel[2];
    rgba.w.e[i] = texel[3];
  }
  return rgba;
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
