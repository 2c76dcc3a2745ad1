// The triangle is clipped to the texel's square (Sutherland and Hodgman, Reentrant polygon clipping, 1974); the place
// is the texel's centre if the triangle contains it, else the centroid of the clipped polygon, which is always on the
// triangle.
#include "lighting/texel_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace twinshade {
namespace {

struct Polygon {
  std::array<glm::dvec2, 8> corner;
  int count = 0;
  void add(const glm::dvec2& p) { corner[count++] = p; }
};

// The part where sign * p[axis] <= sign * limit.
Polygon clip(const Polygon& in, int axis, double sign, double limit) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const glm::dvec2 &a = in.corner[i], &b = in.corner[(i + 1) % in.count];
    const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
    if (da <= 0) out.add(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      glm::dvec2 p = a + (b - a) * (da / (da - db));
      p[axis] = limit;
      out.add(p);
    }
  }
  return out;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

struct Part {
  double area = 0;  // in texels
  glm::dvec2 centroid{0};
};

Part part_in_texel(const Polygon& triangle, std::uint32_t x, std::uint32_t y) {
  Polygon polygon = clip(triangle, 0, -1, x);
  polygon = clip(polygon, 0, 1, x + 1.0);
  polygon = clip(polygon, 1, -1, y);
  polygon = clip(polygon, 1, 1, y + 1.0);
  if (polygon.count < 3) return {};

  // As a fan around the first corner
  const glm::dvec2 first = polygon.corner[0];
  double twice_area = 0;
  glm::dvec2 moment(0);
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const glm::dvec2 a = polygon.corner[i] - first, b = polygon.corner[i + 1] - first;
    const double part = cross(a, b);
    twice_area += part;
    moment += (a + b) * part;
  }
  if (twice_area == 0) return {};
  return {std::abs(twice_area) / 2, first + moment / (3 * twice_area)};
}

}  // namespace

double triangle_area(const Scene& scene, std::size_t triangle) {
  const std::uint32_t* v = scene.indices.data() + 3 * triangle;
  const glm::dvec3 a(scene.positions[v[0]]), b(scene.positions[v[1]]), c(scene.positions[v[2]]);
  const double area = glm::length(glm::cross(b - a, c - a)) / 2;
  return std::isfinite(area) ? area : 0;
}

std::vector<TexelOwner> texel_owners(const Scene& scene, std::uint32_t size) {
  std::vector<TexelOwner> owners(std::size_t(size) * size);
  const auto offer = [&](std::uint32_t x, std::uint32_t y, std::uint32_t triangle, double area, double b1, double b2) {
    TexelOwner& owner = owners[std::size_t(y) * size + x];
    if (area > owner.area) owner = {triangle, area, b1, b2, owner.surface};
  };
  const auto clamped = [&](double coordinate) {
    return std::uint32_t(std::clamp(std::floor(coordinate), 0.0, double(size - 1)));
  };

  for (std::uint32_t t = 0; t < scene.triangle_count(); ++t) {
    glm::dvec2 p[3];
    bool finite = true;
    for (int k = 0; k < 3; ++k) {
      p[k] = glm::dvec2(scene.lightmap_uvs[scene.indices[3 * t + k]]) * double(size);
      finite = finite && std::isfinite(p[k].x) && std::isfinite(p[k].y);
    }
    if (!finite) continue;
    const glm::dvec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const double twice_area = cross(e1, e2);
    if (twice_area == 0) {
      const glm::dvec2 middle = (p[0] + p[1] + p[2]) / 3.0;
      const std::uint32_t x = clamped(middle.x), y = clamped(middle.y);
      offer(x, y, t, 0, 1.0 / 3, 1.0 / 3);
      owners[std::size_t(y) * size + x].surface += triangle_area(scene, t);
      continue;
    }
    const glm::dvec2 low = glm::min(glm::min(p[0], p[1]), p[2]), high = glm::max(glm::max(p[0], p[1]), p[2]);
    if (high.x < 0 || high.y < 0 || low.x > size || low.y > size) continue;
    const double surface_of_texel = triangle_area(scene, t) / (std::abs(twice_area) / 2);
    Polygon whole;
    for (const glm::dvec2& corner : p) whole.add(corner);
    for (std::uint32_t y = clamped(low.y); y <= clamped(high.y); ++y) {
      // The texels that the row's part of the triangle reaches, and one more on each side for its rounding.
      const Polygon row = clip(clip(whole, 1, -1, y), 1, 1, y + 1.0);
      double left = high.x, right = low.x;
      for (int i = 0; i < row.count; ++i)
        left = std::min(left, row.corner[i].x), right = std::max(right, row.corner[i].x);
      left = std::max(low.x, left - 1), right = std::min(high.x, right + 1);
      for (std::uint32_t x = clamped(left); x <= clamped(right); ++x) {
        const auto barycentric = [&](const glm::dvec2& at, double& b1, double& b2) {
          b1 = cross(at - p[0], e2) / twice_area;
          b2 = cross(e1, at - p[0]) / twice_area;
        };
        const Part part = part_in_texel(whole, x, y);
        owners[std::size_t(y) * size + x].surface += part.area * surface_of_texel;
        double b1, b2;
        barycentric({x + 0.5, y + 0.5}, b1, b2);
        if (b1 >= 0 && b2 >= 0 && b1 + b2 <= 1) {
          offer(x, y, t, 2, b1, b2);
          continue;
        }
        if (part.area == 0) continue;
        barycentric(part.centroid, b1, b2);
        b1 = std::clamp(b1, 0.0, 1.0);
        b2 = std::clamp(b2, 0.0, 1.0 - b1);
        offer(x, y, t, std::min(1.0, part.area), b1, b2);
      }
    }
  }
  return owners;
}

}  // namespace twinshade
