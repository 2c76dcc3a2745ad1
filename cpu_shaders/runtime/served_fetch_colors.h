// exact_fetch_5 of shaders/exact/bilinear.glsl and sphere_map_fetch_5 of shaders/sphere_map/taps.glsl: the colours of
// five layers, which LayerOrder::colors_together lays into one cache line. Maps laid out so are read here alone, so every
// policy has these.
#pragma once

#include <array>

#include "cpu_shaders/runtime/served_fetch.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {

template <class N>
using Colors5 = arr<vec<typename N::F, 3>, 5>;

namespace detail {

inline bool has_colors_together(const TextureView& view) { return view.layer_pitch == 3; }

template <class F>
TWINSHADE_FUNCTION vec<F, 3> rgb(const vec<F, 4>& texel) {
  return {texel.x, texel.y, texel.z};
}

// A call: shaders fetch in many places, and this is long. It writes to the caller's, since copies of fifteen registers
// cost.
template <int W>
__attribute__((noinline)) TWINSHADE_WHOLE void filter_colors_apart(const float* texels, const Taps<W>& taps,
                                                                   arr<vec<Simd<float, W>, 3>, 5>& colors) {
  vec<Simd<float, W>, 4> m[4];
  if (taps.same_for_all_lanes())
    for (int l = 0; l < 4; ++l) m[l] = filtered_once(texels, taps, 4 * l);
  else
    filtered_layers<W>(texels, TapIndices<W>(taps), TapWeights<W>(taps), 0, m);
  colors.e[0] = {m[0].x, m[0].y, m[0].z};
  colors.e[1] = {m[0].w, m[1].x, m[1].y};
  colors.e[2] = {m[1].z, m[1].w, m[2].x};
  colors.e[3] = {m[2].y, m[2].z, m[2].w};
  colors.e[4] = {m[3].x, m[3].y, m[3].z};
}

template <class N>
TWINSHADE_FUNCTION Colors5<N> filtered_5(const float* texels, const Taps<N::width>& taps) {
  Colors5<N> colors;
  filter_colors_apart<N::width>(texels, taps, colors);
  return colors;
}

// As GLSL's int does.
inline std::int32_t times(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}
inline std::int32_t plus(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

struct LaneTexel {
  std::int32_t x, y, layer;  // anything: clamped
};

// texels_of(lane): where the first of five layers is in the four texels. One number at a time: for policies without
// lanes, and for layers that do not begin a five.
template <class N, class TexelsOf>
TWINSHADE_APART Colors5<N> colors_by_lane(const TextureView& view, const vec<typename N::F, 4>& weight,
                                          TexelsOf texels_of) {
  using E = typename N::F::element;
  const auto clamp = [](std::int32_t i, std::int32_t size) { return i < 0 ? 0 : i < size ? i : size - 1; };
  Colors5<N> colors;
  for (int lane = 0; lane < N::width; ++lane) {
    const std::array<LaneTexel, 4> at = texels_of(lane);
    const E w[4] = {weight.x.lane(lane), weight.y.lane(lane), weight.z.lane(lane), weight.w.lane(lane)};
    for (std::int32_t k = 0; k < 5; ++k)
      for (std::int32_t c = 0; c < 3; ++c) {
        E texel[4];
        for (std::size_t tap = 0; tap < 4; ++tap) {
          const std::ptrdiff_t layer = clamp(plus(at[tap].layer, k), view.layers);
          texel[tap] =
              E(view.texels[clamp(at[tap].y, view.height) * view.row_pitch +
                            clamp(at[tap].x, view.width) * view.texel_pitch + layer / 5 * 16 + layer % 5 * 3 + c]);
        }
        const E sum = (texel[0] * w[0] + texel[1] * w[1]) + (texel[2] * w[2] + texel[3] * w[3]);
        vec<typename N::F, 3>& color = colors.e[k];
        (c == 0 ? color.x : c == 1 ? color.y : color.z).set_lane(lane, sum);
      }
  }
  return colors;
}

// As the GLSL of sphere_map_fetch has it.
template <class N, class Maps, class Map>
TWINSHADE_FUNCTION vec<typename N::F, 3> sphere_map_color(const TextureView& view,
                                                          const vec<typename N::I, 3> (&texels)[4],
                                                          const vec<typename N::F, 4>& weight, const Maps& maps,
                                                          const Map& map) {
  using Ints = typename N::I;
  const auto texel = [&](int tap) TWINSHADE_LAMBDA {
    using twinshade::detail::clamp_to_size;
    return twinshade::detail::fetch<typename N::real>(
        view, clamp_to_size(texels[tap].x, view.width), clamp_to_size(texels[tap].y, view.height),
        clamp_to_size(texels[tap].z * Ints(maps) + Ints(map), view.layers));
  };
  return rgb((texel(0) * weight.x + texel(1) * weight.y) + (texel(2) * weight.z + texel(3) * weight.w));
}

// Five maps whose layers lie apart.
template <class N, class Maps>
TWINSHADE_APART Colors5<N> sphere_map_colors_from_layers(const TextureView& view,
                                                         const vec<typename N::I, 3> (&texels)[4],
                                                         const vec<typename N::F, 4>& weight, const Maps& maps,
                                                         const typename N::I& five) {
  using Ints = typename N::I;
  const auto map = [&](int k) TWINSHADE_LAMBDA {
    return sphere_map_color<N>(view, texels, weight, maps, five * Ints(5) + Ints(k));
  };
  return {{map(0), map(1), map(2), map(3), map(4)}};
}

}  // namespace detail

template <class N>
inline constexpr bool has_exact_fetch_5 = true;
template <class N>
inline constexpr bool has_sphere_map_fetch_5 = true;

// Of maps whose layers lie apart, as other renderers than ours have them: kept out of the shader's code.
template <class N, class Real, class ExactTaps, Lane I>
TWINSHADE_APART Colors5<N> exact_fetch_5_from_layers(Sampler2DArray<Real> maps, const ExactTaps& taps, const I& five) {
  const I last(maps.view->layers - 1);
  const auto layer = [&](int k) TWINSHADE_LAMBDA {
    return detail::rgb(exact_fetch<N>(maps, taps, lanes_min(five * I(5) + I(k), last)));
  };
  return {{layer(0), layer(1), layer(2), layer(3), layer(4)}};
}

template <class N, class Real, class ExactTaps, Lane I>
TWINSHADE_FUNCTION Colors5<N> exact_fetch_5(Sampler2DArray<Real> maps, const ExactTaps& taps, const I& five) {
  const TextureView& view = *maps.view;
  if (!detail::has_colors_together(view)) return exact_fetch_5_from_layers<N>(maps, taps, five);
  if constexpr (is_simd<N>) {
    using U = typename N::U;
    const auto first_of_five = [&] {
      auto where = detail::locate<N>(view, taps);
      for (auto& at : where.at) at = at + U(five.template to<std::uint32_t>() * 4u);
      return where;
    };
    const I whole(static_cast<std::int32_t>(view.texel_pitch / 16));
    if (all(five >= I(0) & five < whole)) return detail::filtered_5<N>(view.texels, first_of_five());
    if constexpr (I::width == 1)
      if (five.value() == whole.value() && view.texel_pitch % 16 != 0) {  // one layer is left
        const auto only = detail::rgb(detail::filtered<N::width>(view.texels, first_of_five()));
        return {{only, only, only, only, only}};
      }
  }
  const vec<typename N::I, 4> texel(taps.texel);
  using LaneTexel = detail::LaneTexel;
  return detail::colors_by_lane<N>(view, vec<typename N::F, 4>(taps.weight), [&](int lane) {
    const std::int32_t x0 = texel.x.lane(lane), y0 = texel.y.lane(lane), x1 = texel.z.lane(lane),
                       y1 = texel.w.lane(lane);
    const std::int32_t first = detail::times(typename N::I(five).lane(lane), 5);
    return std::array{LaneTexel{x0, y0, first}, LaneTexel{x1, y0, first}, LaneTexel{x0, y1, first},
                      LaneTexel{x1, y1, first}};
  });
}

template <class N, class Real, class SphereMapTaps, Lane Maps, Lane Five>
TWINSHADE_FUNCTION Colors5<N> sphere_map_fetch_5(Sampler2DArray<Real> array, const SphereMapTaps& taps,
                                                 const Maps& maps, const Five& five) {
  using Ints = typename N::I;
  const TextureView& view = *array.view;
  const vec<Ints, 3> texels[4] = {vec<Ints, 3>(taps.texel_00), vec<Ints, 3>(taps.texel_10), vec<Ints, 3>(taps.texel_01),
                                  vec<Ints, 3>(taps.texel_11)};
  const vec<typename N::F, 4> weight(taps.weight);
  if (!detail::has_colors_together(view))
    return detail::sphere_map_colors_from_layers<N>(view, texels, weight, maps, Ints(five));
  if constexpr (is_simd<N> && Maps::width == 1 && Five::width == 1) {
    // Fives of maps are fives of layers, and every lane's is one that there is.
    const Ints fives(static_cast<std::int32_t>(view.texel_pitch / 16));
    const auto group = [&](int tap) TWINSHADE_LAMBDA { return texels[tap].z * Ints(maps.value() / 5) + Ints(five); };
    const auto inside = [&](int tap) TWINSHADE_LAMBDA { return group(tap) >= Ints(0) & group(tap) < fives; };
    if (maps.value() % 5 == 0 && five.value() >= 0 && five.value() < maps.value() / 5 &&
        all(inside(0) & inside(1) & inside(2) & inside(3))) {
      using U = typename N::U;
      const auto at = [&](int tap) TWINSHADE_LAMBDA {
        using twinshade::detail::clamp_to_size;
        return twinshade::detail::texel_index(view, clamp_to_size(texels[tap].x, view.width),
                                              clamp_to_size(texels[tap].y, view.height)) +
               group(tap).template to<std::uint32_t>() * U(4u);
      };
      return detail::filtered_5<N>(view.texels, detail::Taps<N::width>{{at(0), at(1), at(2), at(3)}, weight});
    }
  }
  return detail::colors_by_lane<N>(view, weight, [&](int lane) {
    std::array<detail::LaneTexel, 4> at;
    for (std::size_t tap = 0; tap < 4; ++tap) {
      const std::int32_t slice = detail::times(texels[tap].z.lane(lane), Ints(maps).lane(lane));
      at[tap] = {texels[tap].x.lane(lane), texels[tap].y.lane(lane),
                 detail::plus(slice, detail::times(Ints(five).lane(lane), 5))};
    }
    return at;
  });
}

}  // namespace served
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
