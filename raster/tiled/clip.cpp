// Polygon clipping by planes in turn (Sutherland and Hodgman, Reentrant polygon clipping, 1974) in homogeneous
// coordinates. Order of planes, the end that t starts from and the rounding of each step are Mesa 22.3's (read in
// draw_pipe_clip.c): they decide the subpixel positions of new vertices. Runs with denormals flushed.
#include "raster/tiled/clip.h"

#include <cmath>

#include "raster/tiled/window.h"

namespace twinshade::tiled {
namespace {

// In the order of ClipBit.
constexpr float kPlanes[6][4] = {{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0, 0, -1, 1}};

// The products with 0 stay: they turn an infinite coordinate into NaN.
float plane_distance(const float p[4], const float plane[4]) {
  return p[0] * plane[0] + p[1] * plane[1] + p[2] * plane[2] + p[3] * plane[3];
}

}  // namespace

ClippedTriangle clip_triangle(const float positions[12], std::uint32_t outside) {
  ClippedTriangle result;
  result.polygon = {0, 1, 2};
  result.count = 3;
  const auto position = [&](std::uint8_t v) { return v < 3 ? positions + 4 * v : result.added[v - 3].position; };

  for (int plane = 0; plane < 6 && result.count >= 3; ++plane) {
    if (!(outside >> plane & 1)) continue;
    std::array<std::uint8_t, kMostPolygonVertices> kept;
    int kept_count = 0;
    bool too_many = result.count >= kMostPolygonVertices;
    const auto keep = [&](std::uint8_t v) {
      if (kept_count == kMostPolygonVertices)
        too_many = true;
      else
        kept[std::size_t(kept_count++)] = v;
    };
    // The point where the edge leaves the plane's inside, measured from its end that is nearer to the plane.
    const auto cut = [&](std::uint8_t near_end, float near_distance, std::uint8_t far_end, float t_denominator) {
      if (result.added_count == kMostPolygonVertices + 1) {
        too_many = true;
        return;
      }
      NewVertex& v = result.added[std::size_t(result.added_count)];
      v.from = near_end;
      v.to = far_end;
      v.t = near_distance / t_denominator;
      const float* a = position(near_end);
      const float* b = position(far_end);
      for (int i = 0; i < 4; ++i) v.position[i] = a[i] + v.t * (b[i] - a[i]);
      keep(std::uint8_t(3 + result.added_count++));
    };

    std::uint8_t previous = result.polygon[0];
    float previous_distance = plane_distance(position(previous), kPlanes[plane]);
    if (!std::isfinite(previous_distance)) return {};
    for (int i = 1; i <= result.count; ++i) {
      const std::uint8_t vertex = result.polygon[std::size_t(i == result.count ? 0 : i)];
      const float distance = plane_distance(position(vertex), kPlanes[plane]);
      if (!std::isfinite(distance)) return {};
      const bool previous_inside = previous_distance >= 0;
      if (previous_inside) keep(previous);
      if (previous_inside != !(distance < 0)) {
        const float difference = distance - previous_distance;
        const bool vertex_is_nearer = distance < 0 ? -distance < previous_distance : !(-previous_distance < distance);
        if (vertex_is_nearer)
          cut(vertex, distance, previous, difference);
        else
          cut(previous, -previous_distance, vertex, difference);
      }
      previous = vertex;
      previous_distance = distance;
    }
    if (too_many) return {};
    result.polygon = kept;
    result.count = kept_count;
  }
  return result;
}

}  // namespace twinshade::tiled
