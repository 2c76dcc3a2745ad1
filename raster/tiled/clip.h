// A triangle cut by the planes of the view volume.
#pragma once

#include <array>
#include <cstdint>

namespace twinshade::tiled {

// Vertices of the cut polygon are numbered: 0, 1, 2 the triangle's own, 3 + k the k-th new one.
struct NewVertex {
  float position[4];      // clip space
  std::uint8_t from, to;  // vertex numbers: position = from + t * (to - from), and so every attribute
  float t;
};

// A convex polygon gains at most one vertex a plane, 9 in all. Rounding can make it not quite convex: the limits are
// Mesa's, and a polygon beyond them is dropped, as there.
inline constexpr int kMostPolygonVertices = 29;

struct ClippedTriangle {
  std::array<std::uint8_t, kMostPolygonVertices> polygon;
  std::array<NewVertex, kMostPolygonVertices + 1> added;
  int count = 0;  // of polygon; below 3: nothing is left
  int added_count = 0;
};

// positions: 12 floats. outside: the planes to cut by (ClipBit), those that any of the vertices is outside of.
ClippedTriangle clip_triangle(const float positions[12], std::uint32_t outside);

}  // namespace twinshade::tiled
