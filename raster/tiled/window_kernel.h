// Perspective division, viewport and snapping as measured on Mesa 22.3 (docs/raster-rule.md). Run with denormals
// flushed. Written for one vertex; compilers turn the loop into vectors.
#pragma once

#include "cpu_shaders/runtime/isa.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

// The scale is a power of two: times it is exact, so fusing it with the addition changes nothing.
TWINSHADE_INLINE WindowPosition window_position(const float* clip, const Viewport& viewport) {
  const float reciprocal_w = 1.0f / clip[3];
  return {clip[0] * reciprocal_w * viewport.scale_x + viewport.scale_x,
          clip[1] * reciprocal_w * viewport.scale_y + viewport.scale_y, clip[2] * reciprocal_w * 0.5f + 0.5f,
          reciprocal_w};
}

// Products of three w, which exact attributes are made of, are numbers where each is within these.
inline constexpr float kLeastW = 0x1p-24f, kGreatestW = 0x1p30f;

TWINSHADE_INLINE std::int32_t snapped(float window) {
  const float subpixels = (window - 0.5f) * float(kSubpixel);
  // To nearest, ties to even: the default rounding mode is never changed.
  return __builtin_fabsf(subpixels) < float(kSnapLimit) ? std::int32_t(__builtin_rintf(subpixels)) : kUnusable;
}

// Comparisons are written so that NaN is outside.
TWINSHADE_INLINE std::uint32_t outside_planes(const float* clip) {
  const float x = clip[0], y = clip[1], z = clip[2], w = clip[3];
  // 0 * x is NaN for NaN and infinities, 0 or -0 else.
  const float finite = (0.0f * x + 0.0f * y) + (0.0f * z + 0.0f * w);
  return (x <= w ? 0u : kClipRight) | (x + w >= 0 ? 0u : kClipLeft) | (y <= w ? 0u : kClipTop) |
         (y + w >= 0 ? 0u : kClipBottom) | (z + w >= 0 ? 0u : kClipNear) | (z <= w ? 0u : kClipFar) |
         (finite == 0 ? 0u : kNotFinite);
}

template <bool positions>
TWINSHADE_INLINE void transform_vertices_if(const TransformVertices& call) {
  const float* clip = call.clip_positions;
  WindowVertex* __restrict__ out = call.vertices;
  WindowPosition* __restrict__ to = call.positions;
  const Viewport viewport = call.viewport;
  const std::size_t count = call.count;
  for (std::size_t v = 0; v < count; ++v) {
    const WindowPosition position = window_position(clip + 4 * v, viewport);
    const float w = clip[4 * v + 3];
    const bool tells = (w >= kLeastW) & (w <= kGreatestW);
    out[v] = {snapped(position.x), snapped(position.y), outside_planes(clip + 4 * v), tells ? position.z : -1.0f};
    if constexpr (positions) to[v] = position;
  }
}

inline void transform_vertices(const TransformVertices& call) {
  call.positions ? transform_vertices_if<true>(call) : transform_vertices_if<false>(call);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
