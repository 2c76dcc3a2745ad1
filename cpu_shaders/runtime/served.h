// Equivalents of functions of shaders/exact/.
//
// Scalar64: the transcendentals, in double. Their GLSL bodies are float polynomials over bit casts: in double they
// would measure the polynomial's error instead of the rounding's.
//
// Lanes: exact_fetch, the written-out bilinear filter. Its sum is done on whole texels, four lanes' RGBA to a register
// group, and transposed once, where the GLSL as written would transpose four times. Same operations on the same
// operands in the same order: same bits, held to by a test.
#pragma once

#include "base/portable_math.h"
#include "cpu_shaders/runtime/texture.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {

template <class N>
inline constexpr bool is_double = !N::is_exact_float;
template <class N>
inline constexpr bool is_simd = false;
template <int W>
inline constexpr bool is_simd<Lanes<W>> = true;

// clang-format off
#define TWINSHADE_SERVED_DOUBLE(name, function)                                                                    \
  template <class N>                                                                                               \
  inline constexpr bool has_##name = is_double<N>;                                                                 \
  template <class N, class... A>                                                                                   \
  TWINSHADE_INLINE typename N::F name(const A&... a) {                                                             \
    return map_lanes([](auto... x) TWINSHADE_LAMBDA { return function(x...); }, typename N::F(a)...);                               \
  }
TWINSHADE_SERVED_DOUBLE(exact_exp2, portable::exp2)
TWINSHADE_SERVED_DOUBLE(exact_log2, portable::log2)
TWINSHADE_SERVED_DOUBLE(exact_pow, portable::pow)
TWINSHADE_SERVED_DOUBLE(exact_sin, portable::sin)
TWINSHADE_SERVED_DOUBLE(exact_cos, portable::cos)
TWINSHADE_SERVED_DOUBLE(exact_atan2, portable::atan2)
TWINSHADE_SERVED_DOUBLE(exact_acos, portable::acos)
TWINSHADE_SERVED_DOUBLE(exact_asin, portable::asin)
#undef TWINSHADE_SERVED_DOUBLE
// clang-format on

namespace detail {

// A lane's value in all four channels of its texel, in the layout of transpose_groups' row j.
template <int j, class V>
TWINSHADE_INLINE V spread_lane(const V& lanes) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(lanes, lanes, (k / 4 * 4 + j)...);
  }
  (std::make_integer_sequence<int, sizeof(V) / 4>());
}

// Texel indices of W lanes in memory.
template <int W>
struct TapIndices {
  alignas(64) std::uint32_t at[4][W];
};

// Lanes first .. first + W - 1 of the whole.
template <int W, int All>
TWINSHADE_INLINE vec<Simd<float, W>, 4> filtered_texels(const float* texels, const TapIndices<All>& taps, int first,
                                                        const vec<Simd<float, W>, 4>& weight) {
  if constexpr (Simd<float, W>::whole) {
    Register<float, W> rows[4];
    const auto row = [&]<int j>(std::integral_constant<int, j>) TWINSHADE_LAMBDA {
      const auto texel = [&](int tap) TWINSHADE_LAMBDA {
        return registers::texel_row<W>(
            [&](int i) TWINSHADE_LAMBDA { return registers::load_texel(texels, taps.at[tap][first + i]); }, j);
      };
      rows[j] = (texel(0) * spread_lane<j>(weight.x.v) + texel(1) * spread_lane<j>(weight.y.v)) +
                (texel(2) * spread_lane<j>(weight.z.v) + texel(3) * spread_lane<j>(weight.w.v));
    };
    row(std::integral_constant<int, 0>());
    row(std::integral_constant<int, 1>());
    row(std::integral_constant<int, 2>());
    row(std::integral_constant<int, 3>());
    registers::transpose_groups(rows);
    vec<Simd<float, W>, 4> rgba;
    rgba.x.v = rows[0], rgba.y.v = rows[1], rgba.z.v = rows[2], rgba.w.v = rows[3];
    return rgba;
  } else {
    using Half = vec<Simd<float, W / 2>, 4>;
    const auto low =
        filtered_texels<W / 2>(texels, taps, first, Half(weight.x.lo, weight.y.lo, weight.z.lo, weight.w.lo));
    const auto high =
        filtered_texels<W / 2>(texels, taps, first + W / 2, Half(weight.x.hi, weight.y.hi, weight.z.hi, weight.w.hi));
    vec<Simd<float, W>, 4> rgba;
    rgba.x.lo = low.x, rgba.y.lo = low.y, rgba.z.lo = low.z, rgba.w.lo = low.w;
    rgba.x.hi = high.x, rgba.y.hi = high.y, rgba.z.hi = high.z, rgba.w.hi = high.w;
    return rgba;
  }
}

// taps: the struct ExactTaps of bilinear.glsl, texel = x0 y0 x1 y1, weight of (x0,y0) (x1,y0) (x0,y1) (x1,y1).
// layer_offset: of the first texel of each lane's layer, in texels.
template <class N, class Taps>
TWINSHADE_INLINE vec<typename N::F, 4> filtered(const TextureView& view, const float* texels, const Taps& taps,
                                                const typename N::U& layer_offset) {
  using twinshade::detail::clamp_to_size;
  using I = typename N::I;
  using U = typename N::U;
  const vec<I, 4> texel(taps.texel);
  const U row(static_cast<std::uint32_t>(view.row_pitch / 4));
  const U x0 = clamp_to_size(texel.x, view.width).template to<std::uint32_t>();
  const U x1 = clamp_to_size(texel.z, view.width).template to<std::uint32_t>();
  const U y0 = clamp_to_size(texel.y, view.height).template to<std::uint32_t>() * row + layer_offset;
  const U y1 = clamp_to_size(texel.w, view.height).template to<std::uint32_t>() * row + layer_offset;
  TapIndices<N::width> indices;
  (y0 + x0).store(indices.at[0]);
  (y0 + x1).store(indices.at[1]);
  (y1 + x0).store(indices.at[2]);
  (y1 + x1).store(indices.at[3]);
  return filtered_texels<N::width>(texels, indices, 0, vec<typename N::F, 4>(taps.weight));
}

// One uniform fetch for all lanes: as the GLSL has it.
template <class Taps, class Fetch>
TWINSHADE_INLINE auto uniform_fetch(const Taps& taps, Fetch fetch) {
  const auto low =
      fetch(taps.texel.x, taps.texel.y) * taps.weight.x + fetch(taps.texel.z, taps.texel.y) * taps.weight.y;
  return low + (fetch(taps.texel.x, taps.texel.w) * taps.weight.z + fetch(taps.texel.z, taps.texel.w) * taps.weight.w);
}

}  // namespace detail

template <class N>
inline constexpr bool has_exact_fetch = is_simd<N>;

template <class N, class Real, class Taps>
TWINSHADE_INLINE vec<typename N::F, 4> exact_fetch(Sampler2D<Real> map, const Taps& taps) {
  if constexpr (is_simd<N>) {
    return detail::filtered<N>(*map.view, map.view->texels, taps, typename N::U(0u));
  } else {
    return detail::uniform_fetch(taps, [&](const auto& x, const auto& y) TWINSHADE_LAMBDA {
      return glsl::texelFetch(map, vec<typename N::I, 2>(x, y), typename N::UI(0));
    });
  }
}
template <class N, class Real, class Taps, Lane I>
TWINSHADE_INLINE vec<typename N::F, 4> exact_fetch(Sampler2DArray<Real> maps, const Taps& taps, const I& layer) {
  if constexpr (!is_simd<N>) {
    return detail::uniform_fetch(taps, [&](const auto& x, const auto& y) TWINSHADE_LAMBDA {
      return glsl::texelFetch(maps, vec<typename N::I, 3>(x, y, layer), typename N::UI(0));
    });
  } else {
    const TextureView& view = *maps.view;
    const auto slice = twinshade::detail::clamp_to_size(layer, view.layers);
    if constexpr (I::width == 1) {
      return detail::filtered<N>(view, view.texels + slice.value() * view.layer_pitch, taps, typename N::U(0u));
    } else {
      using U = typename N::U;
      return detail::filtered<N>(
          view, view.texels, taps,
          slice.template to<std::uint32_t>() * U(static_cast<std::uint32_t>(view.layer_pitch / 4)));
    }
  }
}

}  // namespace served
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
