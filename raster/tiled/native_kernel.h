// Native attributes: what Mesa 22.3's llvmpipe computes from ordinary varyings, without fused multiply-add
// (docs/raster-rule.md). Plane equations through unsnapped window positions, origin at pixel (0, 0)'s centre.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

template <class R>
struct Plane {
  R origin, dx, dy;
  template <class F>
  TWINSHADE_INLINE F at(F x, F y) const {
    return F(dy) * y + (F(dx) * x + F(origin));
  }
};

template <class R>
struct PlaneSetup {
  R x0, y0;                  // of the first vertex, from the centre of pixel (0, 0)
  R dx01, dy01, dx20, dy20;  // over twice the area
  R reciprocal_w[3];

  TWINSHADE_INLINE explicit PlaneSetup(const NativeTriangle& t) {
    const WindowPosition* p = t.position;
    x0 = R(p[0].x) - R(0.5);
    y0 = R(p[0].y) - R(0.5);
    dx01 = R(p[0].x) - R(p[1].x);
    dy01 = R(p[0].y) - R(p[1].y);
    dx20 = R(p[2].x) - R(p[0].x);
    dy20 = R(p[2].y) - R(p[0].y);
    const R reciprocal_area = R(1) / (dx01 * dy20 - dy01 * dx20);
    dx01 *= reciprocal_area;
    dy01 *= reciprocal_area;
    dx20 *= reciprocal_area;
    dy20 *= reciprocal_area;
    for (int v = 0; v < 3; ++v) reciprocal_w[v] = R(p[v].reciprocal_w);
  }

  // Through the values at the three vertices.
  TWINSHADE_INLINE Plane<R> plane(R a0, R a1, R a2) const {
    const R da01 = a0 - a1, da20 = a2 - a0;
    Plane<R> p;
    p.dx = da01 * dy20 - da20 * dy01;
    p.dy = da20 * dx01 - da01 * dx20;
    p.origin = a0 - (p.dx * x0 + p.dy * y0);
    return p;
  }
  // For smooth inputs: of the value over w; to be divided by the plane of 1 / w at the pixel.
  TWINSHADE_INLINE Plane<R> plane_over_w(R a0, R a1, R a2) const {
    return plane(a0 * reciprocal_w[0], a1 * reciprocal_w[1], a2 * reciprocal_w[2]);
  }
  TWINSHADE_INLINE Plane<R> plane_of_reciprocal_w() const {
    return plane(reciprocal_w[0], reciprocal_w[1], reciprocal_w[2]);
  }
};

// Inputs of vertex `v` of a native triangle, component 0.
TWINSHADE_INLINE const float* native_inputs(const LocalPrimitive& p, const VertexData& vertices, int v) {
  const std::uint32_t vertex = p.native->vertex[v];
  const float* rows = vertex & kClippedVertex ? p.clipped_inputs : vertices.inputs;
  return rows + std::size_t(vertex & ~kClippedVertex) * vertices.input_components;
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
