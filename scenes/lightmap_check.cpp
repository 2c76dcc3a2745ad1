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

// An edge of a triangle that lies to its left; in samples.
struct MapEdge {
  dvec2 start, along;
  double slack;  // kSlack times its length

  // Rounding keeps order: of a row's samples as computed, those inside are all before or all behind one place.
  bool has_inside(int x, int y) const { return cross(along, dvec2(x + 0.5, y + 0.5) - start) > slack; }

  // Leaves of the samples [first, last) of row y those inside: near where the row crosses the edge, by trying.
  void narrow(int y, int& first, int& last) const {
    if (along.y == 0) {
      if (!has_inside(first, y)) last = first;
      return;
    }
    const double crossing = start.x + (along.x * (y + 0.5 - start.y) - slack) / along.y;
    int cut = int(std::clamp(crossing, double(first), double(last)));
    if (along.y > 0) {  // inside are those before it
      while (cut > first && !has_inside(cut - 1, y)) --cut;
      while (cut < last && has_inside(cut, y)) ++cut;
      last = cut;
    } else {
      while (cut < last && !has_inside(cut, y)) ++cut;
      while (cut > first && has_inside(cut - 1, y)) --cut;
      first = cut;
    }
  }
};

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
    std::array<MapEdge, 3> edges;
    double slack = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec2 along = p[(k + 1) % 3] - p[k];
      edges[k] = {p[k], in_map > 0 ? along : -along, kSlack * glm::length(along)};
      slack += edges[k].slack;
    }
    // Too thin for a sample that is off all three edges: what remains has rows in proportion to its area.
    if (std::fabs(in_map) < 0.99 * slack) continue;
    const dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
    for (int y = int(low.y); y <= std::min(kGrid - 1, int(high.y)); ++y) {
      int first = int(low.x), last = std::min(kGrid, int(high.x) + 1);
      for (const MapEdge& edge : edges) edge.narrow(y, first, last);
      for (int x = first; x < last; ++x) {
        const std::size_t at = std::size_t(y) * kGrid + std::size_t(x);
        if (taken[at]) return "charts overlap";
        taken[at] = true;
      }
    }
  }
  if (flat > 0.01 * area) return "some triangles have no area in them";
  return "";
}

}  // namespace twinshade
