#include "scenes/face_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace twinshade {

using glm::dvec3;

std::vector<glm::vec3> face_normals(const std::vector<glm::vec3>& corner_positions, double cos_crease) {
  const std::size_t corners = corner_positions.size();
  std::vector<dvec3> area(corners / 3), unit(corners / 3);
  for (std::size_t t = 0; t < area.size(); ++t) {
    const dvec3 a(corner_positions[3 * t]), b(corner_positions[3 * t + 1]), c(corner_positions[3 * t + 2]);
    area[t] = glm::cross(b - a, c - a);
    const double length = glm::length(area[t]);
    unit[t] = length > 0 ? area[t] / length : dvec3(0);
  }
  // Corners in one place stand next to each other, in the order of triangles.
  std::vector<std::uint32_t> order(corners);
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    const glm::vec3& p = corner_positions[i];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto pa = place(a), pb = place(b);
    return pa != pb ? pa < pb : a < b;
  });
  std::vector<glm::vec3> normals(corners);
  for (std::size_t start = 0; start < corners;) {
    std::size_t end = start;
    while (end < corners && place(order[end]) == place(order[start])) ++end;
    dvec3 all(0);  // of what has an area
    for (std::size_t i = start; i < end; ++i) all += area[order[i] / 3];
    for (std::size_t i = start; i < end; ++i) {
      const std::size_t own = order[i] / 3;
      const bool degenerate = unit[own] == dvec3(0);
      dvec3 sum = degenerate ? all : area[own];
      if (cos_crease < 1 && !degenerate)
        for (std::size_t j = start; j < end; ++j) {
          const std::size_t other = order[j] / 3;
          if (other != own && glm::dot(unit[own], unit[other]) >= cos_crease) sum += area[other];
        }
      const double length = glm::length(sum);
      normals[order[i]] = length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
    }
    start = end;
  }
  return normals;
}

}  // namespace twinshade
