// Clip space to window space, once per vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "bundle/bundle.h"

namespace twinshade::tiled {

// Subpixel positions: 8 fractional bits, the origin at the centre of pixel (0, 0), so that a pixel centre is a multiple
// of kSubpixel. y upwards.
inline constexpr std::int32_t kSubpixel = 256;

// Positions this far from the origin (in subpixels) come only from vertices at the eye point, where the division by w
// has lost every digit; triangles using them are dropped.
inline constexpr std::int32_t kSnapLimit = 1 << 23;
inline constexpr std::int32_t kUnusable = INT32_MIN;

enum ClipBit : std::uint32_t {  // in the order in which planes are clipped against
  kClipRight = 1,
  kClipLeft = 2,
  kClipTop = 4,
  kClipBottom = 8,
  kClipNear = 16,
  kClipFar = 32,
  kNotFinite = 64,  // a component of the position is NaN or infinite
};

struct WindowVertex {
  std::int32_t x, y;      // subpixels; kUnusable where beyond kSnapLimit or NaN
  std::uint32_t outside;  // ClipBit set
  float depth;            // nearly that of the raster rule; negative where w is too small or too large to tell
};

// Window position in pixels and 1 / w, kept for native attributes only.
struct WindowPosition {
  float x, y, z, reciprocal_w;
};

struct Viewport {
  float scale_x, scale_y;  // half the power-of-two viewport, which is also its centre
};
Viewport make_viewport(std::uint32_t frame_width, std::uint32_t frame_height);

// The rounding of every step is part of the raster rule: 1 / w, times it, times the scale, plus the centre.
WindowPosition to_window(const float clip[4], const Viewport& viewport);
WindowVertex snap(const WindowPosition& position, std::uint32_t outside);

}  // namespace twinshade::tiled
