#include "raster/tiled/window.h"

#include "raster/tiled/window_kernel.h"

namespace twinshade::tiled {

Viewport make_viewport(std::uint32_t frame_width, std::uint32_t frame_height) {
  const auto [width, height] = viewport_size(frame_width, frame_height);
  return {float(width) * 0.5f, float(height) * 0.5f};
}

WindowPosition to_window(const float clip[4], const Viewport& viewport) { return window_position(clip, viewport); }

WindowVertex snap(const WindowPosition& position, std::uint32_t outside) {
  return {snapped(position.x), snapped(position.y), outside, 0};
}

}  // namespace twinshade::tiled
