// GLSL 4.50 section 8.9: the forms of texture lookup beside texture and texelFetch, over textures of one mip level.
// textureOffset adds offset / size to the coordinate; textureProj multiplies by the reciprocal of the last component,
// as Mesa does; textureGather gives component k of the four texels that linear filtering would weigh, whatever the
// filter: (x0, y1), (x1, y1), (x1, y0), (x0, y0).
#pragma once

#include "cpu_shaders/runtime/texture.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace detail {

// A coordinate moved by `offset` texels.
template <Lane F, Vec Offset>
TWINSHADE_INLINE auto moved(const TextureView& view, const vec<F, 2>& p, const Offset& offset) {
  using E = typename F::element;
  const auto step = [](const auto& texels, std::int32_t size) TWINSHADE_LAMBDA {
    const auto count = texels.template to<E>();
    return count / decltype(count)(static_cast<E>(size));
  };
  const auto x = p.x + step(offset.x, view.width);
  return vec<std::remove_const_t<decltype(x)>, 2>(x, p.y + step(offset.y, view.height));
}
template <Lane F, Vec Offset>
TWINSHADE_INLINE auto moved(const TextureView& view, const vec<F, 3>& p, const Offset& offset) {
  const auto xy = moved(view, vec<F, 2>(p.x, p.y), offset);
  using X = typename decltype(xy)::element;
  return vec<X, 3>(xy.x, xy.y, X(p.z));
}

// The two texels along one axis. At an edge that clamps both are the texel there, where linear_taps gives its neighbour
// for the second: it has no weight.
template <Lane F>
TWINSHADE_INLINE auto gathered_taps(const F& s, std::int32_t size, Wrap wrap) {
  using E = typename F::element;
  auto taps = linear_taps(s, size, wrap);
  if (wrap == Wrap::clamp_to_edge)
    taps.second = select(s * F(static_cast<E>(size)) < F(E(0.5)), taps.first, taps.second);
  return taps;
}

template <Lane F, Lane I>
TWINSHADE_INLINE auto gather(const TextureView& view, const F& s, const F& t, const I& layer, Wrap wrap, int k) {
  const auto x = gathered_taps(s, view.width, wrap);
  const auto y = gathered_taps(t, view.height, wrap);
  const auto texel = [&](const auto& column, const auto& row)
                         TWINSHADE_LAMBDA { return fetch<typename F::element>(view, column, row, layer)[k]; };
  return vec<F, 4>(texel(x.first, y.second), texel(x.second, y.second), texel(x.second, y.first),
                   texel(x.first, y.first));
}

}  // namespace detail

namespace glsl {

template <class S, Vec P, Vec Offset>
TWINSHADE_INLINE auto textureOffset(S s, const P& p, const Offset& offset) {
  return texture(s, detail::moved(*s.view, p, offset));
}

// The divisor is the third component: SPIR-V has brought it there.
template <class S, Vec P>
TWINSHADE_INLINE auto textureProj(S s, const P& p) {
  const auto q = detail::constant_for(p.z, 1) / p.z;
  return texture(s, vec<typename P::element, 2>(p.x * q, p.y * q));
}
template <class S, Vec P, Vec Offset>
TWINSHADE_INLINE auto textureProj(S s, const P& p, const Offset& offset) {
  const auto q = detail::constant_for(p.z, 1) / p.z;
  return textureOffset(s, vec<typename P::element, 2>(p.x * q, p.y * q), offset);
}

template <class Real, Lane F>
TWINSHADE_INLINE auto textureGather(Sampler2D<Real> s, const vec<F, 2>& p, Plain<std::int32_t, 1> k) {
  using I = typename F::template with<std::int32_t>;
  return detail::gather(*s.view, p.x, p.y, I(0), s.view->wrap, k.value());
}
template <class Real, Lane F>
TWINSHADE_INLINE auto textureGather(Sampler2DArray<Real> s, const vec<F, 3>& p, Plain<std::int32_t, 1> k) {
  using I = typename F::template with<std::int32_t>;
  const I layer = detail::clamp_to_size(I(lanes_round_even(p.z)), s.view->layers);
  return detail::gather(*s.view, p.x, p.y, layer, s.view->wrap, k.value());
}
template <class Real, Lane F>
TWINSHADE_INLINE auto textureGather(SamplerCube<Real> s, const vec<F, 3>& p, Plain<std::int32_t, 1> k) {
  const auto on_face = detail::cube_face(p);
  return detail::gather(*s.view, on_face.s, on_face.t, on_face.face, Wrap::clamp_to_edge, k.value());
}
template <class S, Vec P, Vec Offset>
TWINSHADE_INLINE auto textureGather(S s, const P& p, Plain<std::int32_t, 1> k, const Offset& offset) {
  return textureGather(s, detail::moved(*s.view, p, offset), k);
}
// textureGatherOffsets: of each of four footprints the texel (x0, y0).
template <class S, Vec P, class Offset>
TWINSHADE_INLINE auto textureGather(S s, const P& p, Plain<std::int32_t, 1> k, const arr<Offset, 4>& offsets) {
  const auto corner = [&](int i) TWINSHADE_LAMBDA { return textureGather(s, p, k, offsets[i]).w; };
  return vec<typename P::element, 4>(corner(0), corner(1), corner(2), corner(3));
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
