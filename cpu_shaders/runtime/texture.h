// Samplers over RGBA32F textures of one mip level. texelFetch and textureSize are part of the exact dialect; texture
// and textureLod follow Mesa's llvmpipe as it filters on a processor without fused multiply-add: level 0 always (there
// is one level), full float weights, lerp a + w * (b - a), x first, cube maps not seamless.
//
// Every lane, active or not, reads inside the texture: texelFetch clamps coordinates and layer (OpenGL leaves a fetch
// out of range undefined; robust contexts give zero), and NaN coordinates read texel 0.
#pragma once

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/runtime/texel_load.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// Real: what fetches return, float or double (the float texels widened).
template <class Real>
struct Sampler2D {
  const TextureView* view;
};
template <class Real>
struct Sampler2DArray {
  const TextureView* view;
};
template <class Real>
struct SamplerCube {
  const TextureView* view;
};

namespace detail {

template <Lane I>
TWINSHADE_INLINE I clamp_to_size(const I& i, std::int32_t size) {
  return lanes_max(lanes_min(i, I(size - 1)), I(0));
}

// In twos of floats, as places of texels are: the largest scale of an x86 address.
template <class U>
TWINSHADE_INLINE U pitch(std::ptrdiff_t floats) {
  return U(static_cast<std::uint32_t>(static_cast<std::size_t>(floats) / 2));
}

// Where a texel of layer 0 lies; fits 32 bits (32 GiB). Coordinates in range.
template <Lane I>
TWINSHADE_INLINE auto texel_index(const TextureView& view, const I& x, const I& y) {
  using U = typename I::template with<std::uint32_t>;
  return y.template to<std::uint32_t>() * pitch<U>(view.row_pitch) +
         x.template to<std::uint32_t>() * pitch<U>(view.texel_pitch);
}

// Coordinates in range.
template <class Real, Lane I>
TWINSHADE_INLINE auto fetch(const TextureView& view, const I& x, const I& y, const I& layer) {
  using U = typename I::template with<std::uint32_t>;
  return load_texels<Real>(view.texels,
                           texel_index(view, x, y) + layer.template to<std::uint32_t>() * pitch<U>(view.layer_pitch));
}
template <class Real, Lane I>
TWINSHADE_INLINE auto fetch(const TextureView& view, const I& x, const I& y) {
  return load_texels<Real>(view.texels, texel_index(view, x, y));
}

template <Lane F>
struct LinearTaps {
  typename F::template with<std::int32_t> first, second;
  F weight;
};

// The two texels along one axis and the weight of the second; `s` in texture widths.
template <Lane F>
TWINSHADE_INLINE LinearTaps<F> linear_taps(const F& s, std::int32_t size, Wrap wrap) {
  using I = typename F::template with<std::int32_t>;
  using E = typename F::element;
  const F extent(static_cast<E>(size)), half(E(0.5));
  const I last(size - 1), one(1);
  if (wrap == Wrap::clamp_to_edge) {
    const F u = lanes_max(lanes_min(s * extent, extent) - half, F(E(0)));
    const F cell = lanes_floor(u);
    const I first = clamp_to_size(I(cell), size);
    return {first, lanes_min(first + one, last), u - cell};
  }
  const bool power_of_two = (size & (size - 1)) == 0;
  const F u = (power_of_two ? s : s - lanes_floor(s)) * extent - half;
  const F cell = lanes_floor(u);
  const I index(cell);
  if (power_of_two) return {index & last, (index + one) & last, u - cell};
  const I first = clamp_to_size(select(index < I(0), last, index), size);
  return {first, select(first == last, I(0), first + one), u - cell};
}

template <Lane F>
TWINSHADE_INLINE auto nearest_tap(const F& s, std::int32_t size, Wrap wrap) {
  using I = typename F::template with<std::int32_t>;
  const F extent(static_cast<typename F::element>(size));
  if (wrap == Wrap::clamp_to_edge) return clamp_to_size(I(s * extent), size);
  if ((size & (size - 1)) == 0) return I(lanes_floor(s * extent)) & I(size - 1);
  return clamp_to_size(I((s - lanes_floor(s)) * extent), size);
}

template <class V, Lane F>
TWINSHADE_INLINE auto lerp_texels(const V& a, const V& b, const F& w) {
  return a + w * (b - a);
}

template <class Real, Lane F, Lane I>
TWINSHADE_INLINE auto sample(const TextureView& view, const F& s, const F& t, const I& layer, Wrap wrap) {
  if (view.filter == Filter::nearest) {
    return fetch<Real>(view, nearest_tap(s, view.width, wrap), nearest_tap(t, view.height, wrap), layer);
  }
  const auto x = linear_taps(s, view.width, wrap);
  const auto y = linear_taps(t, view.height, wrap);
  const auto low =
      lerp_texels(fetch<Real>(view, x.first, y.first, layer), fetch<Real>(view, x.second, y.first, layer), x.weight);
  const auto high =
      lerp_texels(fetch<Real>(view, x.first, y.second, layer), fetch<Real>(view, x.second, y.second, layer), x.weight);
  return lerp_texels(low, high, y.weight);
}

template <Lane F>
struct CubeFace {
  F s, t;
  typename F::template with<std::int32_t> face;
};

// OpenGL 4.5 table 8.19: face order +X -X +Y -Y +Z -Z.
template <Lane F>
TWINSHADE_INLINE CubeFace<F> cube_face(const vec<F, 3>& p) {
  using I = typename F::template with<std::int32_t>;
  using E = typename F::element;
  const F ax = lanes_abs(p.x), ay = lanes_abs(p.y), az = lanes_abs(p.z);
  const auto on_z = az >= lanes_max(ax, ay);
  const auto on_x = (ax > ay) & !on_z;
  const F major = select(on_z, p.z, select(on_x, p.x, p.y));
  const auto negative = major < F(E(0));
  const F sc = select(on_z, select(negative, -p.x, p.x), select(on_x, select(negative, p.z, -p.z), p.x));
  const F tc = select(on_z | on_x, -p.y, select(negative, -p.z, p.z));
  const F scale = F(E(0.5)) / lanes_abs(major);
  const F half(E(0.5));
  const I face = select(on_z, I(4), select(on_x, I(0), I(2))) + select(negative, I(1), I(0));
  return {sc * scale + half, tc * scale + half, face};
}

}  // namespace detail

namespace glsl {

// Of the one level, whichever is asked for.
template <class Real, class Lod = Plain<std::int32_t, 1>>
TWINSHADE_INLINE vec<Plain<std::int32_t, 1>, 2> textureSize(Sampler2D<Real> s, const Lod& = {}) {
  return {Plain<std::int32_t, 1>(s.view->width), Plain<std::int32_t, 1>(s.view->height)};
}
template <class Real, class Lod = Plain<std::int32_t, 1>>
TWINSHADE_INLINE vec<Plain<std::int32_t, 1>, 3> textureSize(Sampler2DArray<Real> s, const Lod& = {}) {
  return {Plain<std::int32_t, 1>(s.view->width), Plain<std::int32_t, 1>(s.view->height),
          Plain<std::int32_t, 1>(s.view->layers)};
}
template <class Real, class Lod = Plain<std::int32_t, 1>>
TWINSHADE_INLINE vec<Plain<std::int32_t, 1>, 2> textureSize(SamplerCube<Real> s, const Lod& = {}) {
  return {Plain<std::int32_t, 1>(s.view->width), Plain<std::int32_t, 1>(s.view->height)};
}

template <class Real, Lane I, class Lod>
TWINSHADE_INLINE auto texelFetch(Sampler2D<Real> s, const vec<I, 2>& p, const Lod&) {
  return detail::fetch<Real>(*s.view, detail::clamp_to_size(p.x, s.view->width),
                             detail::clamp_to_size(p.y, s.view->height));
}
template <class Real, Lane I, class Lod>
TWINSHADE_INLINE auto texelFetch(Sampler2DArray<Real> s, const vec<I, 3>& p, const Lod&) {
  return detail::fetch<Real>(*s.view, detail::clamp_to_size(p.x, s.view->width),
                             detail::clamp_to_size(p.y, s.view->height), detail::clamp_to_size(p.z, s.view->layers));
}

template <class Real, Lane F, class Lod>
TWINSHADE_INLINE auto textureLod(Sampler2D<Real> s, const vec<F, 2>& p, const Lod&) {
  using I = typename F::template with<std::int32_t>;
  return detail::sample<Real>(*s.view, p.x, p.y, I(0), s.view->wrap);
}
template <class Real, Lane F, class Lod>
TWINSHADE_INLINE auto textureLod(Sampler2DArray<Real> s, const vec<F, 3>& p, const Lod&) {
  using I = typename F::template with<std::int32_t>;
  const I layer = detail::clamp_to_size(I(lanes_round_even(p.z)), s.view->layers);
  return detail::sample<Real>(*s.view, p.x, p.y, layer, s.view->wrap);
}
template <class Real, Lane F, class Lod>
TWINSHADE_INLINE auto textureLod(SamplerCube<Real> s, const vec<F, 3>& p, const Lod&) {
  const auto at = detail::cube_face(p);
  return detail::sample<Real>(*s.view, at.s, at.t, at.face, Wrap::clamp_to_edge);
}

// One level: implicit derivatives have nothing to choose.
template <class S, Vec P>
TWINSHADE_INLINE auto texture(S s, const P& p) {
  return textureLod(s, p, Plain<std::int32_t, 1>(0));
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
