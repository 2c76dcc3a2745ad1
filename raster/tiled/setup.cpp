// Triangle setup: integer edge functions with the fill rule folded in (Pineda, A parallel algorithm for polygon
// rasterization, 1988).
#include <algorithm>
#include <utility>

#include "raster/tiled/geometry.h"

namespace twinshade::tiled {

bool set_up_triangle(const WindowVertex v[3], const TileGrid& grid, bool cull_back_faces, RasterTriangle& out) {
  std::int64_t x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    if (v[i].x == kUnusable || v[i].y == kUnusable) return false;
    x[i] = v[i].x;
    y[i] = v[i].y;
  }
  const std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0 || (area < 0 && cull_back_faces)) return false;
  if (area < 0) {
    std::swap(x[0], x[1]);
    std::swap(y[0], y[1]);
  }
  out.front_facing = area > 0 ? ~0u : 0u;

  // Pixel centres are multiples of kSubpixel: the first at or after the least coordinate, the last at or before the
  // greatest.
  const std::int64_t least_x = std::min(std::min(x[0], x[1]), x[2]), greatest_x = std::max(std::max(x[0], x[1]), x[2]);
  const std::int64_t least_y = std::min(std::min(y[0], y[1]), y[2]), greatest_y = std::max(std::max(y[0], y[1]), y[2]);
  const std::int64_t min_x = std::max<std::int64_t>((least_x + kSubpixel - 1) >> 8, 0);
  const std::int64_t min_y = std::max<std::int64_t>((least_y + kSubpixel - 1) >> 8, 0);
  const std::int64_t max_x = std::min<std::int64_t>(greatest_x >> 8, std::int64_t(grid.frame_width) - 1);
  const std::int64_t max_y = std::min<std::int64_t>(greatest_y >> 8, std::int64_t(grid.frame_height) - 1);
  if (min_x > max_x || min_y > max_y) return false;
  out.min_x = std::uint16_t(min_x);
  out.min_y = std::uint16_t(min_y);
  out.max_x = std::uint16_t(max_x);
  out.max_y = std::uint16_t(max_y);

  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const std::int64_t a = y[i] - y[j], b = x[j] - x[i];
    // Counter-clockwise with y up: a > 0 goes down, so the inside is to its right; a = 0, b > 0 has the inside above.
    const bool holds_its_points = a > 0 || (a == 0 && b > 0);
    const std::int64_t c = -(a * x[i] + b * y[i]) - (holds_its_points ? 0 : 1);
    out.a[i] = std::int32_t(a);
    out.b[i] = std::int32_t(b);
    out.c[i] = c >> 8;  // steps are multiples of kSubpixel, so rounding down keeps the sign at every pixel centre
  }
  return true;
}

}  // namespace twinshade::tiled
