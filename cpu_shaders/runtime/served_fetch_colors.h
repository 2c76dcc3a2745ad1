// exact_fetch_colors of shaders/exact/fetch_colors.glsl and sphere_map_fetch_colors of
// shaders/sphere_map/fetch_colors.glsl: the colours of all layers, which LayerOrder::colors_together lays into cache
// lines of five. Maps laid out so are read here alone, so every policy has these.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "cpu_shaders/runtime/served_fetch.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {

template <class N, int count>
using Colors = arr<vec<typename N::F, 3>, count>;

namespace detail {

// As GLSL's int does.
inline std::int32_t times(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}
inline std::int32_t plus(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

inline bool has_colors_together(const TextureView& view) { return view.layer_pitch == 3; }

struct LaneTexel {
  std::int32_t x, y, layer;  // anything: clamped
};

template <class T>
std::array<T, 8> joined(const std::array<T, 4>& a, const std::array<T, 4>& b) {
  return {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
}

// The sum for one lane of channel c of a layer: texels and weights of T taps. One number at a time.
template <class E, std::size_t T>
E weighted_color(const TextureView& view, const std::array<LaneTexel, T>& at, const std::array<E, T>& weight,
                 std::int32_t layer, std::int32_t c) {
  const auto clamp = [](std::int32_t i, std::int32_t size) { return i < 0 ? 0 : i < size ? i : size - 1; };
  const auto product = [&](std::size_t tap) {
    const std::ptrdiff_t slice = clamp(plus(at[tap].layer, layer), view.layers);
    return E(view.texels[clamp(at[tap].y, view.height) * view.row_pitch +
                         clamp(at[tap].x, view.width) * view.texel_pitch + slice / 5 * 16 + slice % 5 * 3 + c]) *
           weight[tap];
  };
  const auto four = [&](std::size_t tap) {
    return (product(tap) + product(tap + 1)) + (product(tap + 2) + product(tap + 3));
  };
  if constexpr (T == 4)
    return four(0);
  else
    return four(0) + four(4);
}

// taps_of(lane): where the first layer is in the texels, and their weights. For policies without lanes, and for layers
// that are not those of a texel's lines.
template <class N, int count, class TapsOf>
TWINSHADE_APART void colors_by_lane(const TextureView& view, TapsOf taps_of, Colors<N, count>& colors) {
  for (int lane = 0; lane < N::width; ++lane) {
    const auto [at, weight] = taps_of(lane);
    for (std::int32_t layer = 0; layer < count; ++layer) {
      vec<typename N::F, 3>& color = colors.e[layer];
      color.x.set_lane(lane, weighted_color(view, at, weight, layer, 0));
      color.y.set_lane(lane, weighted_color(view, at, weight, layer, 1));
      color.z.set_lane(lane, weighted_color(view, at, weight, layer, 2));
    }
  }
}

// The taps of ExactTaps in lane `lane`, in layer 0, and those of SphereMapTaps, in map 0 of `maps`.
template <class N, class ExactTaps>
TWINSHADE_FUNCTION std::array<LaneTexel, 4> lane_texels(const ExactTaps& taps, int lane) {
  const vec<typename N::I, 4> texel(taps.texel);
  const std::int32_t x0 = texel.x.lane(lane), y0 = texel.y.lane(lane), x1 = texel.z.lane(lane), y1 = texel.w.lane(lane);
  return {{{x0, y0, 0}, {x1, y0, 0}, {x0, y1, 0}, {x1, y1, 0}}};
}
template <class N, class SphereMapTaps, class Maps>
TWINSHADE_FUNCTION std::array<LaneTexel, 4> lane_texels(const SphereMapTaps& taps, const Maps& maps, int lane) {
  const auto texel = [&](const vec<typename N::I, 3>& t) TWINSHADE_LAMBDA {
    return LaneTexel{t.x.lane(lane), t.y.lane(lane), times(t.z.lane(lane), typename N::I(maps).lane(lane))};
  };
  using Texel = vec<typename N::I, 3>;
  return {texel(Texel(taps.texel_00)), texel(Texel(taps.texel_10)), texel(Texel(taps.texel_01)),
          texel(Texel(taps.texel_11))};
}
template <class N, class Taps>
TWINSHADE_FUNCTION std::array<typename N::F::element, 4> lane_weights(const Taps& taps, int lane) {
  const vec<typename N::F, 4> weight(taps.weight);
  return {weight.x.lane(lane), weight.y.lane(lane), weight.z.lane(lane), weight.w.lane(lane)};
}

// As the GLSL of sphere_map_fetch has it.
template <class N, class SphereMapTaps, class Maps>
TWINSHADE_FUNCTION vec<typename N::F, 3> sphere_map_color(const TextureView& view, const SphereMapTaps& taps,
                                                          const Maps& maps, int map) {
  using I = typename N::I;
  const auto texel = [&](const vec<I, 3>& t) TWINSHADE_LAMBDA {
    using twinshade::detail::clamp_to_size;
    return twinshade::detail::fetch<typename N::real>(view, clamp_to_size(t.x, view.width),
                                                      clamp_to_size(t.y, view.height),
                                                      clamp_to_size(t.z * I(maps) + I(map), view.layers));
  };
  const vec<typename N::F, 4> weight(taps.weight);
  return rgb((texel(vec<I, 3>(taps.texel_00)) * weight.x + texel(vec<I, 3>(taps.texel_10)) * weight.y) +
             (texel(vec<I, 3>(taps.texel_01)) * weight.z + texel(vec<I, 3>(taps.texel_11)) * weight.w));
}

// --- of maps whose layers lie apart, as other renderers than ours have them: kept out of the shader's code

template <class N, int count, class Layer>
TWINSHADE_APART void colors_by_layer(Colors<N, count>& colors, Layer layer) {
  for (int k = 0; k < count; ++k) colors.e[k] = layer(k);
}

}  // namespace detail

template <class N>
inline constexpr bool has_exact_fetch_colors = true;
template <class N>
inline constexpr bool has_sphere_map_fetch_colors = true;

template <class N, class Real, class ExactTaps, int count>
TWINSHADE_FUNCTION void exact_fetch_colors(Sampler2DArray<Real> maps, const ExactTaps& taps, Colors<N, count>& colors) {
  using I = Plain<std::int32_t, 1>;
  const TextureView& view = *maps.view;
  if (!detail::has_colors_together(view))
    return detail::colors_by_layer<N, count>(colors, [maps, taps](int k) TWINSHADE_LAMBDA {
      return detail::rgb(exact_fetch<N>(maps, taps, I(std::min(k, maps.view->layers - 1))));
    });
  if constexpr (is_simd<N>)
    if (view.layers >= count)
      return detail::with_table<N>(
          view, taps, detail::locate<N>(view, taps),
          [&](const auto& table) TWINSHADE_LAMBDA { detail::filter_colors<count>(view.texels, table, colors); },
          [&](const auto& table) TWINSHADE_LAMBDA { detail::filter_colors_apart<count>(view.texels, table, colors); });
  detail::colors_by_lane<N, count>(
      view,
      [taps](int lane) { return std::pair(detail::lane_texels<N>(taps, lane), detail::lane_weights<N>(taps, lane)); },
      colors);
}

// Sums of what two taps read.
template <class N, class Real, class Low, class High, int count>
TWINSHADE_FUNCTION void exact_fetch_colors(Sampler2DArray<Real> maps, const Low& low, const High& high,
                                           Colors<N, count>& colors) {
  using I = Plain<std::int32_t, 1>;
  const TextureView& view = *maps.view;
  if (!detail::has_colors_together(view))
    return detail::colors_by_layer<N, count>(colors, [maps, low, high](int k) TWINSHADE_LAMBDA {
      const I layer(std::min(k, maps.view->layers - 1));
      return detail::rgb(exact_fetch<N>(maps, low, layer)) + detail::rgb(exact_fetch<N>(maps, high, layer));
    });
  if constexpr (is_simd<N>)
    if (view.layers >= count)
      return detail::filter_colors<count>(
          view.texels, detail::TapTable<N::width, 8>(detail::locate<N>(view, low), detail::locate<N>(view, high)),
          colors);
  detail::colors_by_lane<N, count>(
      view,
      [low, high](int lane) {
        return std::pair(detail::joined(detail::lane_texels<N>(low, lane), detail::lane_texels<N>(high, lane)),
                         detail::joined(detail::lane_weights<N>(low, lane), detail::lane_weights<N>(high, lane)));
      },
      colors);
}

template <class N, class Real, class SphereMapTaps, Lane Maps, int count>
TWINSHADE_FUNCTION void sphere_map_fetch_colors(Sampler2DArray<Real> array, const SphereMapTaps& taps, const Maps& maps,
                                                Colors<N, count>& colors) {
  const TextureView& view = *array.view;
  if (!detail::has_colors_together(view))
    return detail::colors_by_layer<N, count>(colors, [array, taps, maps](int k) TWINSHADE_LAMBDA {
      return detail::sphere_map_color<N>(*array.view, taps, maps, k);
    });
  if constexpr (is_simd<N> && Maps::width == 1) {
    using I = typename N::I;
    using U = typename N::U;
    // A texel's maps begin a line, and every lane has all of them.
    const I lines(maps.value() / 5), most(view.layers / 5 - (count + 4) / 5);
    const auto first_line = [&](const vec<I, 3>& texel) TWINSHADE_LAMBDA { return texel.z * lines; };
    const auto inside = [&](const vec<I, 3>& texel)
                            TWINSHADE_LAMBDA { return first_line(texel) >= I(0) & first_line(texel) <= most; };
    vec<I, 3> texels[4] = {vec<I, 3>(taps.texel_00), vec<I, 3>(taps.texel_10), vec<I, 3>(taps.texel_01),
                           vec<I, 3>(taps.texel_11)};
    if (maps.value() % 5 == 0 && maps.value() >= 0 &&
        all(inside(texels[0]) & inside(texels[1]) & inside(texels[2]) & inside(texels[3]))) {
      const auto at = [&](int tap) TWINSHADE_LAMBDA {
        using twinshade::detail::clamp_to_size;
        return twinshade::detail::texel_index(view, clamp_to_size(texels[tap].x, view.width),
                                              clamp_to_size(texels[tap].y, view.height)) +
               first_line(texels[tap]).template to<std::uint32_t>() * U(8u);
      };
      detail::Taps<N::width> where{{at(0), at(1), at(2), at(3)}, vec<typename N::F, 4>(taps.weight)};
      return detail::filter_colors<count>(view.texels, detail::TapTable<N::width, 4>(where), colors);
    }
  }
  detail::colors_by_lane<N, count>(
      view,
      [taps, maps](int lane) {
        return std::pair(detail::lane_texels<N>(taps, maps, lane), detail::lane_weights<N>(taps, lane));
      },
      colors);
}

}  // namespace served
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
