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
    return lanes_min(lanes_max(d, F(R(0))), F(R(1)));
  }
  TWINSHADE_INLINE F reciprocal_w() const { return sum / w; }
};

// Of a primitive's vertex `v`: x, y, z, w.
TWINSHADE_INLINE const float* clip_position(const VertexData& vertices, std::uint32_t primitive, int v) {
  return vertices.clip_positions + std::size_t(vertices.indices[std::size_t(primitive) * 3 + std::size_t(v)]) * 4;
}

// F: lanes of float or double.
template <class F>
struct ExactTriangle {
  using R = typename F::element;
  // Clip space. x + ndc * -w is x - ndc * w bit for bit, but what has been computed is its one operand, so that the
  // other can be in memory.
  F x[3], y[3], z[3], w[3], minus_w[3];

  ExactTriangle() = default;
  TWINSHADE_INLINE ExactTriangle(const VertexData& vertices, std::uint32_t primitive) {
    for (int v = 0; v < 3; ++v) {
      const float* p = clip_position(vertices, primitive, v);
      x[v] = F(R(p[0]));
      y[v] = F(R(p[1]));
      z[v] = F(R(p[2]));
      w[v] = F(R(p[3]));
      minus_w[v] = -w[v];
    }
  }

  TWINSHADE_INLINE ExactPoint<F> at(F ndc_x, F ndc_y) const { return at(columns(ndc_x), ndc_y); }

  // Of a column of pixels, and so the same for all rows.
  struct Columns {
    F x[3];
  };
  TWINSHADE_INLINE Columns columns(F ndc_x) const {
    return {{x[0] + ndc_x * minus_w[0], x[1] + ndc_x * minus_w[1], x[2] + ndc_x * minus_w[2]}};
  }
  TWINSHADE_INLINE ExactPoint<F> at(const Columns& at_columns, F ndc_y) const {
    const F &x0 = at_columns.x[0], &x1 = at_columns.x[1], &x2 = at_columns.x[2];
    const F y0 = y[0] + ndc_y * minus_w[0];
    const F y1 = y[1] + ndc_y * minus_w[1];
    const F y2 = y[2] + ndc_y * minus_w[2];
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
