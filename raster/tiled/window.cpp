// Perspective division, viewport and snapping as measured on Mesa 22.3 (docs/raster-rule.md). Runs with denormals
// flushed.
#include "raster/tiled/window.h"

#include <cmath>

namespace twinshade::tiled {
namespace {

// Comparisons are written so that NaN is outside.
std::uint32_t outside_planes(const float p[4]) {
  const float x = p[0], y = p[1], z = p[2], w = p[3];
  std::uint32_t bits = 0;
  if (!(x <= w)) bits |= kClipRight;
  if (!(x + w >= 0)) bits |= kClipLeft;
  if (!(y <= w)) bits |= kClipTop;
  if (!(y + w >= 0)) bits |= kClipBottom;
  if (!(z + w >= 0)) bits |= kClipNear;
  if (!(z <= w)) bits |= kClipFar;
  // 0 * x is NaN for NaN and infinities, 0 or -0 else.
  const float finite = (0.0f * x + 0.0f * y) + (0.0f * z + 0.0f * w);
  if (!(finite == 0)) bits |= kNotFinite;
  return bits;
}

std::int32_t snap(float window) {
  const float subpixels = (window - 0.5f) * float(kSubpixel);
  if (!(std::fabs(subpixels) < float(kSnapLimit))) return kUnusable;
  return std::int32_t(std::lrintf(subpixels));  // to nearest, ties to even: the default rounding mode is never changed
}

}  // namespace

Viewport make_viewport(std::uint32_t frame_width, std::uint32_t frame_height) {
  const auto [width, height] = viewport_size(frame_width, frame_height);
  return {float(width) * 0.5f, float(height) * 0.5f};
}

WindowPosition to_window(const float clip[4], const Viewport& viewport) {
  const float reciprocal_w = 1.0f / clip[3];
  // The scale is a power of two: times it is exact, so fusing it with the addition changes nothing.
  return {clip[0] * reciprocal_w * viewport.scale_x + viewport.scale_x,
          clip[1] * reciprocal_w * viewport.scale_y + viewport.scale_y, clip[2] * reciprocal_w * 0.5f + 0.5f,
          reciprocal_w};
}

WindowVertex snap(const WindowPosition& position, std::uint32_t outside) {
  return {snap(position.x), snap(position.y), outside};
}

void transform_vertices(const float* clip_positions, std::size_t begin, std::size_t end, const Viewport& viewport,
                        WindowVertex* out, WindowPosition* positions) {
  for (std::size_t v = begin; v < end; ++v) {
    const float* clip = clip_positions + 4 * v;
    const WindowPosition position = to_window(clip, viewport);
    out[v] = snap(position, outside_planes(clip));
    if (positions) positions[v] = position;
  }
}

}  // namespace twinshade::tiled
