// The written-out bilinear filters of shaders/exact/ and shaders/sphere_map/taps.glsl, for lanes: where the texels are,
// and whether they lie as texel_filter.h takes them. Same operations on the same operands in the same order: same bits,
// held to by a test.
#pragma once

#include <algorithm>

#include "cpu_shaders/runtime/texel_filter.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {

namespace detail {

// The taps of fetches that are inlined are not const in what follows: g++ would keep them in memory, since they are
// stored to.

// The taps that the struct ExactTaps of bilinear.glsl means (texel = x0 y0 x1 y1), in layer 0.
template <class N, class ExactTaps>
TWINSHADE_FUNCTION Taps<N::width> locate(const TextureView& view, const ExactTaps& taps) {
  using twinshade::detail::clamp_to_size;
  using twinshade::detail::pitch;
  using U = typename N::U;
  vec<typename N::I, 4> texel(taps.texel);
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

// With registers of 4 what is loaded twice is little beside what else a filter does.
template <int W>
inline constexpr bool kInPairs = W >= 8 && Simd<float, W>::whole;

// Whether each lane's right texels are those after its left ones: not so where a texture repeats or ends.
template <class N, class ExactTaps>
TWINSHADE_FUNCTION bool side_by_side(const TextureView& view, const ExactTaps& taps) {
  using I = typename N::I;
  const vec<I, 4> texel(taps.texel);
  const typename N::U left = texel.x.template to<std::uint32_t>();
  return all((texel.z == texel.x + I(1)) & (left < typename N::U(static_cast<std::uint32_t>(view.width - 1))));
}

// Calls filter with a TapTable of the taps, which are at `where`: in pairs where that will do, since filters are bound
// by what they load, and half of the places do then. That is nearly always so: what fetches otherwise is a call, which
// all shaders of a unit share.
template <class N, class ExactTaps, class Filter, class Otherwise>
TWINSHADE_FUNCTION void with_table(const TextureView& view, const ExactTaps& taps, const Taps<N::width>& where,
                                   Filter filter, Otherwise otherwise) {
  constexpr int W = N::width;
  if constexpr (kInPairs<W>) {
    if (side_by_side<N>(view, taps))
      filter(TapTable<W, 4, true>(where, view.texel_pitch));
    else
      otherwise(TapTable<W, 4>(where));
  } else {
    filter(TapTable<W, 4>(where));
  }
}

// One uniform fetch for all lanes: as the GLSL has it.
template <class ExactTaps, class Fetch>
TWINSHADE_FUNCTION auto uniform_fetch(const ExactTaps& taps, Fetch fetch) {
  const auto low =
      fetch(taps.texel.x, taps.texel.y) * taps.weight.x + fetch(taps.texel.z, taps.texel.y) * taps.weight.y;
  return low + (fetch(taps.texel.x, taps.texel.w) * taps.weight.z + fetch(taps.texel.z, taps.texel.w) * taps.weight.w);
}

template <class F>
TWINSHADE_FUNCTION vec<F, 3> rgb(const vec<F, 4>& texel) {
  return {texel.x, texel.y, texel.z};
}

}  // namespace detail

template <class N>
inline constexpr bool has_exact_fetch = is_simd<N>;
template <class N>
inline constexpr bool has_exact_fetch_ones = is_simd<N>;
template <class N>
inline constexpr bool has_exact_fetch_threes = is_simd<N>;
template <class N>
inline constexpr bool has_exact_fetch_layers = is_simd<N>;
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
      where.move_by(offset);
      return detail::filtered<N::width>(view.texels, where);
    }
  }
}

// Of layers that lie apart or are not all there: kept out of the shader's code, which reads what is there. Such
// functions are given copies: what they saw themselves would have to be in memory in the shader's code, too.
template <class N, class Real, class ExactTaps, int count>
TWINSHADE_APART void exact_fetch_layers_apart(Sampler2DArray<Real> maps, const ExactTaps& taps,
                                              arr<vec<typename N::F, 4>, count>& layers) {
  for (int k = 0; k < count; ++k)
    layers.e[k] = exact_fetch<N>(maps, taps, Plain<std::int32_t, 1>(std::min(k, maps.view->layers - 1)));
}

template <class N, class Real, class ExactTaps, int count>
TWINSHADE_FUNCTION void exact_fetch_layers(Sampler2DArray<Real> maps, const ExactTaps& taps,
                                           arr<vec<typename N::F, 4>, count>& layers) {
  const TextureView& view = *maps.view;
  if (view.layer_pitch != 4 || view.layers < count) return exact_fetch_layers_apart<N>(maps, ExactTaps(taps), layers);
  detail::with_table<N>(
      view, taps, detail::locate<N>(view, taps),
      [&](const auto& table) TWINSHADE_LAMBDA { detail::filter_layers<count>(view.texels, table, layers.e); },
      [&](const auto& table) TWINSHADE_LAMBDA { detail::filter_layers_apart<count>(view.texels, table, layers.e); });
}

namespace detail {
// Colour k of a run of layers.
template <class F>
TWINSHADE_FUNCTION vec<F, 3>& column(vec<F, 3>& one, int) {
  return one;
}
template <class F>
TWINSHADE_FUNCTION vec<F, 3>& column(mat<F, 3, 3>& three, int k) {
  return three.c[k];
}
}  // namespace detail

template <class N, class Real, class Low, class High, class Run>
TWINSHADE_APART void fetch_runs_apart(Sampler2DArray<Real> maps, const Low& low, const High& high,
                                      const vec<typename N::I, 3>& first, arr<Run, 3>& runs) {
  using I = typename N::I;
  constexpr int length = sizeof(Run) / sizeof(vec<typename N::F, 3>);
  const I last(maps.view->layers - 1);
  const auto fill = [&](const I& from, Run& run) TWINSHADE_LAMBDA {
    for (int k = 0; k < length; ++k) {
      const I at = lanes_min(from + I(k), last);
      detail::column(run, k) = detail::rgb(exact_fetch<N>(maps, low, at)) + detail::rgb(exact_fetch<N>(maps, high, at));
    }
  };
  fill(first.x, runs.e[0]);
  fill(first.y, runs.e[1]);
  fill(first.z, runs.e[2]);
}

// As many layers as Run has colours, from each of three on.
template <class N, class Real, class Low, class High, Vec First, class Run>
TWINSHADE_FUNCTION void fetch_runs(Sampler2DArray<Real> maps, const Low& low, const High& high, const First& first,
                                   arr<Run, 3>& runs) {
  using I = typename N::I;
  constexpr int length = sizeof(Run) / sizeof(vec<typename N::F, 3>);
  const TextureView& view = *maps.view;
  const vec<I, 3> from(first);
  const I most(view.layers - length);
  const auto inside = [&](const I& layer) TWINSHADE_LAMBDA { return (layer >= I(0)) & (layer <= most); };
  if (view.layer_pitch != 4 || !all(inside(from.x) & inside(from.y) & inside(from.z)))
    return fetch_runs_apart<N>(maps, Low(low), High(high), vec<I, 3>(first), runs);
  const auto layer = [](const I& i) TWINSHADE_LAMBDA { return typename N::U(i.template to<std::uint32_t>()); };
  detail::filter_runs<length>(
      view.texels, detail::TapTable<N::width, 8>(detail::locate<N>(view, low), detail::locate<N>(view, high)),
      detail::Starts<N::width, 3>(layer(from.x), layer(from.y), layer(from.z)), runs);
}

template <class N, class Real, class Low, class High, Vec First>
TWINSHADE_FUNCTION void exact_fetch_ones(Sampler2DArray<Real> maps, const Low& low, const High& high,
                                         const First& layer, arr<vec<typename N::F, 3>, 3>& ones) {
  fetch_runs<N>(maps, low, high, layer, ones);
}

template <class N, class Real, class Low, class High, Vec First>
TWINSHADE_FUNCTION void exact_fetch_threes(Sampler2DArray<Real> maps, const Low& low, const High& high,
                                           const First& first, arr<mat<typename N::F, 3, 3>, 3>& threes) {
  fetch_runs<N>(maps, low, high, first, threes);
}

template <class N, class Real, class ExactTaps, Lane I>
TWINSHADE_FUNCTION mat<typename N::F, 2, 4> exact_fetch_pair(Sampler2DArray<Real> first, Sampler2DArray<Real> second,
                                                             const ExactTaps& taps, const I& layer) {
  const TextureView& view = *first.view;
  // Each texel of the one beside that of the other: then all pitches are the same, too.
  if (second.view->texels == view.texels + 4 && view.texel_pitch == 8) {
    using U = typename N::U;
    const auto slice = twinshade::detail::clamp_to_size(layer, view.layers);
    auto where = detail::locate<N>(view, taps);
    where.move_by(U(slice.template to<std::uint32_t>()) * twinshade::detail::pitch<U>(view.layer_pitch));
    if (where.same_for_all_lanes())
      return {detail::filtered_once(view.texels, where, 0), detail::filtered_once(view.texels, where, 4)};
    detail::Unset<mat<typename N::F, 2, 4>> both;
    detail::with_table<N>(
        view, taps, where,
        [&](const auto& table) TWINSHADE_LAMBDA { detail::filter_layers<2>(view.texels, table, both.value.c); },
        [&](const auto& table) TWINSHADE_LAMBDA { detail::filter_layers_apart<2>(view.texels, table, both.value.c); });
    return both.value;
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
