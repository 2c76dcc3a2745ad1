// The written-out bilinear filters of shaders/exact/bilinear.glsl and shaders/sphere_map/taps.glsl, for lanes. Sums are
// done on whole texels, four lanes' RGBA to a register group or one lane's four layers to a row, and transposed once,
// where the GLSL as written would transpose for each texel; where all lanes read the same four texels there is nothing
// to transpose at all. Same operations on the same operands in the same order: same bits, held to by a test.
#pragma once

#include "cpu_shaders/runtime/texture.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {

namespace detail {

// A lane's value in all four channels of its texel, in the layout of transpose_groups' row j.
template <int j, class V>
TWINSHADE_FUNCTION V spread_lane(const V& lanes) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(lanes, lanes, (k / 4 * 4 + j)...);
  }
  (std::make_integer_sequence<int, sizeof(V) / 4>());
}

// The four texels of W lanes, in fours of floats from the texture's first, and their weights: (x0,y0) (x1,y0) (x0,y1)
// (x1,y1).
template <int W>
struct Taps {
  Simd<std::uint32_t, W> at[4];
  vec<Simd<float, W>, 4> weight;

  TWINSHADE_INLINE bool same_for_all_lanes() const {
    const auto same = [&](int tap) TWINSHADE_LAMBDA { return at[tap] == Simd<std::uint32_t, W>(at[tap].lane(0)); };
    return all(same(0) & same(1) & same(2) & same(3));
  }
};
// In memory, where lanes are taken one by one: in twos of floats, the largest scale that an x86 address has.
template <int W>
struct TapIndices {
  alignas(64) std::uint32_t at[4][W];
  TWINSHADE_INLINE explicit TapIndices(const Taps<W>& taps) {
    for (int tap = 0; tap < 4; ++tap) (taps.at[tap] + taps.at[tap]).store(at[tap]);
    __asm__("" : "+m"(at));  // really through memory: compilers would take registers apart lane by lane
  }
  TWINSHADE_INLINE const float* texel(const float* texels, int tap, int lane) const {
    return texels + std::size_t{at[tap][lane]} * 2;
  }
};
template <int W>
struct TapWeights {
  alignas(64) float of[4][W];
  TWINSHADE_INLINE explicit TapWeights(const Taps<W>& taps) {
    taps.weight.x.store(of[0]);
    taps.weight.y.store(of[1]);
    taps.weight.z.store(of[2]);
    taps.weight.w.store(of[3]);
    __asm__("" : "+m"(of));
  }
};

// The taps that the struct ExactTaps of bilinear.glsl means (texel = x0 y0 x1 y1), in layer 0.
template <class N, class ExactTaps>
TWINSHADE_FUNCTION Taps<N::width> locate(const TextureView& view, const ExactTaps& taps) {
  using twinshade::detail::clamp_to_size;
  using twinshade::detail::pitch;
  using U = typename N::U;
  const vec<typename N::I, 4> texel(taps.texel);
  const U row = pitch<U>(view.row_pitch), column = pitch<U>(view.texel_pitch);
  const U x0 = clamp_to_size(texel.x, view.width).template to<std::uint32_t>() * column;
  const U x1 = clamp_to_size(texel.z, view.width).template to<std::uint32_t>() * column;
  const U y0 = clamp_to_size(texel.y, view.height).template to<std::uint32_t>() * row;
  const U y1 = clamp_to_size(texel.w, view.height).template to<std::uint32_t>() * row;
  return {{y0 + x0, y0 + x1, y1 + x0, y1 + x1}, vec<typename N::F, 4>(taps.weight)};
}

// The taps that the struct SphereMapTaps of sphere_map/taps.glsl means (texel_00: x, y, layer of a map), of map `map`
// of `maps` whose layers are interleaved.
template <class N, class SphereMapTaps, class Maps, class Map>
TWINSHADE_FUNCTION Taps<N::width> locate(const TextureView& view, const SphereMapTaps& taps, const Maps& maps,
                                         const Map& map) {
  using twinshade::detail::clamp_to_size;
  using twinshade::detail::pitch;
  using I = typename N::I;
  using U = typename N::U;
  const U slice = pitch<U>(view.layer_pitch);
  const auto at = [&](const vec<I, 3>& texel) TWINSHADE_LAMBDA {
    const I layer = clamp_to_size(texel.z * I(maps) + I(map), view.layers);
    return twinshade::detail::texel_index(view, clamp_to_size(texel.x, view.width),
                                          clamp_to_size(texel.y, view.height)) +
           layer.template to<std::uint32_t>() * slice;
  };
  return {{at(vec<I, 3>(taps.texel_00)), at(vec<I, 3>(taps.texel_10)), at(vec<I, 3>(taps.texel_01)),
           at(vec<I, 3>(taps.texel_11))},
          vec<typename N::F, 4>(taps.weight)};
}

// --- one layer

// Lanes first .. first + W - 1 of the whole.
template <int W, int All>
TWINSHADE_FUNCTION vec<Simd<float, W>, 4> filtered_texels(const float* texels, const TapIndices<All>& taps, int first,
                                                          const vec<Simd<float, W>, 4>& weight) {
  if constexpr (Simd<float, W>::whole) {
    Register<float, W> rows[4];
    const auto row = [&]<int j>(std::integral_constant<int, j>) TWINSHADE_LAMBDA {
      const auto texel = [&](int tap) TWINSHADE_LAMBDA {
        return registers::texel_row<W>(
            [&](int i) TWINSHADE_LAMBDA { return registers::load_texel(taps.texel(texels, tap, first + i), 0); }, j);
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

// Where the four texels are the same for all lanes: their numbers, times each lane's weights. From float `first` on.
template <int W>
TWINSHADE_FUNCTION vec<Simd<float, W>, 4> filtered_once(const float* texels, const Taps<W>& taps, int first) {
  using F = Simd<float, W>;
  const float* texel[4];
  for (int tap = 0; tap < 4; ++tap) texel[tap] = texels + std::size_t{taps.at[tap].lane(0)} * 4 + first;
  const vec<F, 4>& weight = taps.weight;
  const auto channel = [&](int c) TWINSHADE_LAMBDA {
    return (F(texel[0][c]) * weight.x + F(texel[1][c]) * weight.y) +
           (F(texel[2][c]) * weight.z + F(texel[3][c]) * weight.w);
  };
  return {channel(0), channel(1), channel(2), channel(3)};
}

template <int W>
TWINSHADE_FUNCTION vec<Simd<float, W>, 4> filtered(const float* texels, const Taps<W>& taps) {
  if (taps.same_for_all_lanes()) return filtered_once(texels, taps, 0);
  return filtered_texels<W>(texels, TapIndices<W>(taps), 0, taps.weight);
}

// --- two or four layers that lie side by side

template <class V, class Pick>
TWINSHADE_FUNCTION V shuffle(const V& a, const V& b, Pick pick) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(a, b, pick(k)...);
  }
  (std::make_integer_sequence<int, sizeof(V) / 4>());
}
// Blocks of 128 bits 0 and 2, or 1 and 3, of two registers of four.
TWINSHADE_FUNCTION Float16 even_blocks(const Float16& a, const Float16& b) {
  return shuffle(a, b, [](int k) TWINSHADE_LAMBDA { return k / 4 % 2 * 8 + k % 4 + (k >= 8 ? 16 : 0); });
}
TWINSHADE_FUNCTION Float16 odd_blocks(const Float16& a, const Float16& b) {
  return shuffle(a, b, [](int k) TWINSHADE_LAMBDA { return 4 + k / 4 % 2 * 8 + k % 4 + (k >= 8 ? 16 : 0); });
}

// Block b of rows[i] becomes block i of rows[b], for the register's 1, 2 or 4 blocks of 128 bits; rows are those j,
// j + 4 ... of W.
template <class V, int W>
TWINSHADE_FUNCTION void transpose_blocks(V (&rows)[W]) {
  constexpr auto low = [](int k) TWINSHADE_LAMBDA { return k % (W / 2) + (k >= W / 2 ? W : 0); };
  constexpr auto high = [](int k) TWINSHADE_LAMBDA { return W / 2 + k % (W / 2) + (k >= W / 2 ? W : 0); };
  if constexpr (W == 8) {
    for (int j = 0; j < 4; ++j) {
      const V a = rows[j], b = rows[j + 4];
      rows[j] = shuffle(a, b, low);
      rows[j + 4] = shuffle(a, b, high);
    }
  } else if constexpr (W == 16) {
    for (int j = 0; j < 4; ++j) {
      const V ab01 = shuffle(rows[j], rows[j + 4], low), ab23 = shuffle(rows[j], rows[j + 4], high);
      const V cd01 = shuffle(rows[j + 8], rows[j + 12], low), cd23 = shuffle(rows[j + 8], rows[j + 12], high);
      rows[j] = even_blocks(ab01, cd01);
      rows[j + 4] = odd_blocks(ab01, cd01);
      rows[j + 8] = even_blocks(ab23, cd23);
      rows[j + 12] = odd_blocks(ab23, cd23);
    }
  }
}

// The four channels of each of `count` layers, 2 or 4.
template <int W, int count, int All>
TWINSHADE_FUNCTION void filtered_layers(const float* texels, const TapIndices<All>& taps,
                                        const TapWeights<All>& weights, int first,
                                        vec<Simd<float, W>, 4> (&layers)[count]) {
  if constexpr (!Simd<float, W>::whole) {
    vec<Simd<float, W / 2>, 4> low[count], high[count];
    filtered_layers<W / 2>(texels, taps, weights, first, low);
    filtered_layers<W / 2>(texels, taps, weights, first + W / 2, high);
    for (int l = 0; l < count; ++l) {
      layers[l].x.lo = low[l].x, layers[l].y.lo = low[l].y, layers[l].z.lo = low[l].z, layers[l].w.lo = low[l].w;
      layers[l].x.hi = high[l].x, layers[l].y.hi = high[l].y, layers[l].z.hi = high[l].z, layers[l].w.hi = high[l].w;
    }
  } else {
    // Sums of kFloats floats for each lane: a register, or half of one.
    constexpr int kFloats = W < 4 * count ? W : 4 * count, kLayers = kFloats / 4, kParts = count / kLayers;
    // A lane's pointers and weights are loaded once for all parts.
    const auto sum = [&](int lane, auto store) TWINSHADE_LAMBDA {
      const float* texel[4];
      Register<float, kFloats> weight[4];
      for (int tap = 0; tap < 4; ++tap) {
        texel[tap] = taps.texel(texels, tap, first + lane);
        weight[tap] = registers::splat<float, kFloats>(weights.of[tap][first + lane]);
      }
      for (int part = 0; part < kParts; ++part) {
        const auto product = [&](int tap) TWINSHADE_LAMBDA {
          Register<float, kFloats> floats;
          std::memcpy(&floats, texel[tap] + part * kFloats, sizeof floats);
          return floats * weight[tap];
        };
        store(part, (product(0) + product(1)) + (product(2) + product(3)));
      }
    };
    Register<float, W> sums[kParts][4 * kLayers];
    if constexpr (kFloats == W) {
      for (int i = 0; i < W; ++i)
        sum(i, [&](int part, const Register<float, W>& lane) TWINSHADE_LAMBDA { sums[part][i] = lane; });
      for (auto& rows : sums) transpose_blocks(rows);
    } else {
      static_assert(kParts == 1);
      for (int j = 0; j < 4; ++j) {
        Register<float, kFloats> lanes[4];
        for (int i = 0; i < 4; ++i)
          sum(j + 4 * i, [&](int, const Register<float, kFloats>& lane) TWINSHADE_LAMBDA { lanes[i] = lane; });
        const auto a = registers::concatenate(lanes[0], lanes[1]), b = registers::concatenate(lanes[2], lanes[3]);
        sums[0][j] = even_blocks(a, b);
        sums[0][4 + j] = odd_blocks(a, b);
      }
    }
    for (int part = 0; part < kParts; ++part) {
      const Register<float, W>(&rows)[4 * kLayers] = sums[part];  // [4 l + j]: layer l of lanes j, j + 4 ...
      for (int l = 0; l < kLayers; ++l) {
        Register<float, W> channels[4] = {rows[4 * l], rows[4 * l + 1], rows[4 * l + 2], rows[4 * l + 3]};
        registers::transpose_groups(channels);
        vec<Simd<float, W>, 4>& layer = layers[part * kLayers + l];
        layer.x.v = channels[0], layer.y.v = channels[1], layer.z.v = channels[2], layer.w.v = channels[3];
      }
    }
  }
}

// A call: shaders fetch in many places, and this is long.
template <int W, int count>
__attribute__((noinline)) TWINSHADE_WHOLE void filter_layers_apart(const float* texels, const Taps<W>& taps,
                                                                   vec<Simd<float, W>, 4> (&layers)[count]) {
  filtered_layers<W>(texels, TapIndices<W>(taps), TapWeights<W>(taps), 0, layers);
}

// Four layers from the texels on.
template <int W>
TWINSHADE_FUNCTION mat<Simd<float, W>, 4, 4> filtered_4(const float* texels, const Taps<W>& taps) {
  if (taps.same_for_all_lanes())
    return {filtered_once(texels, taps, 0), filtered_once(texels, taps, 4), filtered_once(texels, taps, 8),
            filtered_once(texels, taps, 12)};
  vec<Simd<float, W>, 4> layers[4];
  filter_layers_apart(texels, taps, layers);
  return {layers[0], layers[1], layers[2], layers[3]};
}

// One uniform fetch for all lanes: as the GLSL has it.
template <class ExactTaps, class Fetch>
TWINSHADE_FUNCTION auto uniform_fetch(const ExactTaps& taps, Fetch fetch) {
  const auto low =
      fetch(taps.texel.x, taps.texel.y) * taps.weight.x + fetch(taps.texel.z, taps.texel.y) * taps.weight.y;
  return low + (fetch(taps.texel.x, taps.texel.w) * taps.weight.z + fetch(taps.texel.z, taps.texel.w) * taps.weight.w);
}

}  // namespace detail

template <class N>
inline constexpr bool has_exact_fetch = is_simd<N>;
template <class N>
inline constexpr bool has_exact_fetch_4 = is_simd<N>;
template <class N>
inline constexpr bool has_exact_fetch_pair = is_simd<N>;
template <class N>
inline constexpr bool has_sphere_map_fetch = is_simd<N>;

template <class N, class Real, class ExactTaps>
TWINSHADE_FUNCTION vec<typename N::F, 4> exact_fetch(Sampler2D<Real> map, const ExactTaps& taps) {
  if constexpr (is_simd<N>) {
    return detail::filtered<N::width>(map.view->texels, detail::locate<N>(*map.view, taps));
  } else {
    return detail::uniform_fetch(taps, [&](const auto& x, const auto& y) TWINSHADE_LAMBDA {
      return glsl::texelFetch(map, vec<typename N::I, 2>(x, y), typename N::UI(0));
    });
  }
}
template <class N, class Real, class ExactTaps, Lane I>
TWINSHADE_FUNCTION vec<typename N::F, 4> exact_fetch(Sampler2DArray<Real> maps, const ExactTaps& taps, const I& layer) {
  if constexpr (!is_simd<N>) {
    return detail::uniform_fetch(taps, [&](const auto& x, const auto& y) TWINSHADE_LAMBDA {
      return glsl::texelFetch(maps, vec<typename N::I, 3>(x, y, layer), typename N::UI(0));
    });
  } else {
    const TextureView& view = *maps.view;
    const auto slice = twinshade::detail::clamp_to_size(layer, view.layers);
    auto where = detail::locate<N>(view, taps);
    if constexpr (I::width == 1) {
      return detail::filtered<N::width>(view.texels + slice.value() * view.layer_pitch, where);
    } else {
      using U = typename N::U;
      const U offset = slice.template to<std::uint32_t>() * twinshade::detail::pitch<U>(view.layer_pitch);
      for (auto& at : where.at) at = at + offset;
      return detail::filtered<N::width>(view.texels, where);
    }
  }
}

template <class N, class Real, class ExactTaps, Lane I>
TWINSHADE_FUNCTION mat<typename N::F, 4, 4> exact_fetch_4(Sampler2DArray<Real> maps, const ExactTaps& taps,
                                                          const I& first) {
  if constexpr (is_simd<N>) {
    const TextureView& view = *maps.view;
    // Of the padding only copies of the last layer are read: what the GLSL reads there.
    const I most(static_cast<std::int32_t>(view.texel_pitch / 4) - 4);
    if (view.texel_pitch > 4 && all((first >= I(0)) & (first <= most))) {
      auto where = detail::locate<N>(view, taps);
      if constexpr (I::width == 1)
        return detail::filtered_4<N::width>(view.texels + std::ptrdiff_t{first.value()} * 4, where);
      for (auto& at : where.at) at = at + first.template to<std::uint32_t>();
      return detail::filtered_4<N::width>(view.texels, where);
    }
  }
  const auto layer = [&](int k) TWINSHADE_LAMBDA { return exact_fetch<N>(maps, taps, first + I(k)); };
  return {layer(0), layer(1), layer(2), layer(3)};
}

template <class N, class Real, class ExactTaps, Lane I>
TWINSHADE_FUNCTION mat<typename N::F, 2, 4> exact_fetch_pair(Sampler2DArray<Real> first, Sampler2DArray<Real> second,
                                                             const ExactTaps& taps, const I& layer) {
  if constexpr (is_simd<N>) {
    const TextureView& view = *first.view;
    // Each texel of the one beside that of the other: then all pitches are the same, too.
    if (second.view->texels == view.texels + 4 && view.texel_pitch == 8) {
      using U = typename N::U;
      const auto slice = twinshade::detail::clamp_to_size(layer, view.layers);
      const U offset = U(slice.template to<std::uint32_t>()) * twinshade::detail::pitch<U>(view.layer_pitch);
      auto where = detail::locate<N>(view, taps);
      for (auto& at : where.at) at = at + offset;
      if (where.same_for_all_lanes())
        return {detail::filtered_once(view.texels, where, 0), detail::filtered_once(view.texels, where, 4)};
      vec<typename N::F, 4> both[2];
      detail::filter_layers_apart(view.texels, where, both);
      return {both[0], both[1]};
    }
  }
  return {exact_fetch<N>(first, taps, layer), exact_fetch<N>(second, taps, layer)};
}

template <class N, class Real, class SphereMapTaps, Lane Maps, Lane Map>
TWINSHADE_FUNCTION vec<typename N::F, 4> sphere_map_fetch(Sampler2DArray<Real> array, const SphereMapTaps& taps,
                                                          const Maps& maps, const Map& map) {
  static_assert(is_simd<N>);
  return detail::filtered<N::width>(array.view->texels, detail::locate<N>(*array.view, taps, maps, map));
}

}  // namespace served
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
