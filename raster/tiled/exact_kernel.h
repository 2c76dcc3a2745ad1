// Exact attributes: shaders/exact/attributes.glsl operation by operation, for W pixels of one primitive. That file is
// the definition; a test holds this one to its translation bit for bit.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

template <class F>
struct ExactPoint {
  F e0, e1, e2, sum, z, w;

  TWINSHADE_INLINE F depth() const {
    using R = typename F::element;
    const F d = (z / w) * F(R(0.5)) + F(R(0.5));
    return select(d > F(R(0)), lanes_min(d, F(R(1))), F(R(0)));
  }
  TWINSHADE_INLINE F reciprocal_w() const { return sum / w; }
};

// F: lanes of float or double.
template <class F>
struct ExactTriangle {
  using R = typename F::element;
  F x[3], y[3], z[3], w[3];  // clip space

  TWINSHADE_INLINE ExactTriangle(const VertexData& vertices, std::uint32_t primitive) {
    const std::uint32_t* index = vertices.indices + std::size_t(primitive) * 3;
    for (int v = 0; v < 3; ++v) {
      const float* p = vertices.clip_positions + std::size_t(index[v]) * 4;
      x[v] = F(R(p[0]));
      y[v] = F(R(p[1]));
      z[v] = F(R(p[2]));
      w[v] = F(R(p[3]));
    }
  }

  TWINSHADE_INLINE ExactPoint<F> at(F ndc_x, F ndc_y) const {
    const F x0 = x[0] - ndc_x * w[0];
    const F y0 = y[0] - ndc_y * w[0];
    const F x1 = x[1] - ndc_x * w[1];
    const F y1 = y[1] - ndc_y * w[1];
    const F x2 = x[2] - ndc_x * w[2];
    const F y2 = y[2] - ndc_y * w[2];
    ExactPoint<F> p;
    p.e0 = x1 * y2 - x2 * y1;
    p.e1 = x2 * y0 - x0 * y2;
    p.e2 = x0 * y1 - x1 * y0;
    p.sum = (p.e0 + p.e1) + p.e2;
    p.z = (p.e0 * z[0] + p.e1 * z[1]) + p.e2 * z[2];
    p.w = (p.e0 * w[0] + p.e1 * w[1]) + p.e2 * w[2];
    return p;
  }
};

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
