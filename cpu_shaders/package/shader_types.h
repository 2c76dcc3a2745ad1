// What the headers of translated shaders include: how textures are handed over. Everything else in them is std::array
// and plain numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

// Views of RGBA texels, four floats each, x fastest, then y, then layer; row 0 is at t = 0. The texels stay the
// caller's and must live as long as the view is used. Sizes in texels, at least 1.
inline TextureView texture_2d(const float* rgba, std::int32_t width, std::int32_t height,
                              Filter filter = Filter::linear, Wrap wrap = Wrap::repeat) {
  const std::ptrdiff_t row = 4 * std::ptrdiff_t{width};
  return {rgba, width, height, 1, row, row * height, TextureKind::two_d, filter, wrap};
}
inline TextureView texture_2d_array(const float* rgba, std::int32_t width, std::int32_t height, std::int32_t layers,
                                    Filter filter = Filter::linear, Wrap wrap = Wrap::repeat) {
  TextureView view = texture_2d(rgba, width, height, filter, wrap);
  view.layers = layers;
  view.kind = TextureKind::two_d_array;
  return view;
}
// Six layers in OpenGL's order of faces: +X -X +Y -Y +Z -Z.
inline TextureView texture_cube(const float* rgba, std::int32_t size, Filter filter = Filter::linear) {
  TextureView view = texture_2d_array(rgba, size, size, 6, filter, Wrap::clamp_to_edge);
  view.kind = TextureKind::cube;
  return view;
}

}  // namespace twinshade
