#include "scenes/lightmap_check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kGrid = 1024;
// Samples this near to an edge, in samples, belong to no triangle: float uvs of neighbours may differ by their
// rounding.
constexpr double kSlack = 0.01;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

std::string lightmap_fault(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& uvs,
                           const std::vector<std::uint32_t>& indices) {
  for (const glm::vec2& uv : uvs)
    if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return "some lie outside [0, 1]";
  std::vector<bool> taken(std::size_t(kGrid) * kGrid);
  double area = 0, flat = 0;  // square metres; of triangles that are a line or a point in the map
  for (std::size_t t = 0; t < indices.size(); t += 3) {
    std::array<dvec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = dvec2(uvs[indices[t + k]]) * double(kGrid);
    const dvec3 a(positions[indices[t]]), b(positions[indices[t + 1]]), c(positions[indices[t + 2]]);
    const double in_space = 0.5 * glm::length(glm::cross(b - a, c - a)), in_map = cross(p[1] - p[0], p[2] - p[0]);
    area += in_space;
    if (std::fabs(in_map) < 1e-6) {
      flat += in_space;
      continue;
    }
    const dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
    const double side = in_map > 0 ? 1 : -1;
    for (int y = std::max(0, int(low.y)); y <= std::min(kGrid - 1, int(high.y)); ++y)
      for (int x = std::max(0, int(low.x)); x <= std::min(kGrid - 1, int(high.x)); ++x) {
        const dvec2 sample(x + 0.5, y + 0.5);
        bool inside = true;
        for (std::size_t k = 0; k < 3 && inside; ++k) {
          const dvec2 edge = p[(k + 1) % 3] - p[k];
          inside = side * cross(edge, sample - p[k]) > kSlack * glm::length(edge);
        }
        if (!inside) continue;
        const std::size_t at = std::size_t(y) * kGrid + std::size_t(x);
        if (taken[at]) return "charts overlap";
        taken[at] = true;
      }
  }
  if (flat > 0.01 * area) return "some triangles have no area in them";
  return "";
}

}  // namespace twinshade
