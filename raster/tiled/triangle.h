// What setup hands to coverage and interpolation: plain data, read by code of every instruction set.
#pragma once

#include <cstdint>

#include "raster/tiled/window.h"

namespace twinshade::tiled {

// A triangle ready for coverage. Three edge functions, >= 0 inside; at pixel (x, y) edge i is c[i] + a[i] * x + b[i] *
// y, exactly, in units of kSubpixel square subpixels. Left and low-y edges hold points on them, folded into c.
struct RasterTriangle {
  // Coverage loads four numbers from each, so none of them may be at the end.
  std::int64_t c[3];
  std::int32_t a[3], b[3];
  std::uint16_t min_x, min_y, max_x, max_y;  // pixels whose centres can be inside, within the frame, ends included
  std::uint32_t primitive;                   // position in the bundle's indices / 3
  // Less than its depth at any pixel that it covers, exact or native (docs/raster-rule.md); negative where too little
  // is known.
  float nearest;
};

// What native attributes need besides: window positions and shader inputs of the three vertices, in the order in which
// Mesa's setup gets them (a clockwise triangle's first two swapped).
struct NativeTriangle {
  WindowPosition position[3];
  std::uint32_t vertex[3];     // of the bundle, or kClippedVertex | index of a row in TriangleChunk::clipped_inputs
  std::uint32_t front_facing;  // ~0u: counter-clockwise, else 0
};
inline constexpr std::uint32_t kClippedVertex = 0x80000000u;

}  // namespace twinshade::tiled
