// Cells: great circles cut convex spherical polygons in two (Sutherland and Hodgman, Reentrant polygon clipping, 1974,
// on the cone over the polygon). Triangles: Duffy's map of the square, then projection to the sphere, whose Jacobian is
// det(A, B, C) / |p|^3.
#include "experiments/sphere_cells.h"

#include <cmath>
#include <optional>

#include "base/portable_math.h"

namespace twinshade {
namespace {

using Polygon = std::vector<glm::dvec3>;

// The part of a polygon where side * dot(normal, p) >= 0; nothing where that has no area.
std::optional<Polygon> half_of(const Polygon& polygon, const glm::dvec3& normal, double side) {
  constexpr double kOnPlane = 1e-12;
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = side * glm::dot(normal, a), at_b = side * glm::dot(normal, b);
    if (at_a >= -kOnPlane) part.push_back(a);
    if ((at_a > kOnPlane && at_b < -kOnPlane) || (at_a < -kOnPlane && at_b > kOnPlane))
      part.push_back(glm::normalize(a * at_b - b * at_a) * (at_b > at_a ? 1.0 : -1.0));
  }
  bool inside = false;
  for (const glm::dvec3& corner : part) inside = inside || side * glm::dot(normal, corner) > kOnPlane;
  if (part.size() < 3 || !inside) return std::nullopt;
  return part;
}

std::vector<glm::dvec3> cutting_planes() {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<glm::dvec3> axes;  // one of each pair of opposite vertices
  for (int shift = 0; shift < 3; ++shift)
    for (const double sign : {1.0, -1.0}) {
      glm::dvec3 axis(0);
      axis[(shift + 1) % 3] = sign;
      axis[(shift + 2) % 3] = phi;
      axes.push_back(glm::normalize(axis));
    }
  std::vector<glm::dvec3> planes = axes;
  // Mirror planes are perpendicular to the axes through the middles of edges: sums of neighbouring vertices.
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double side = glm::dot(axes[i], axes[k]) > 0 ? 1 : -1;
      planes.push_back(glm::normalize(axes[i] + side * axes[k]));
    }
  return planes;
}

}  // namespace

LineQuadrature line_quadrature(int points) {
  // A ring of sphere_quadrature is a node: its height, and its weight over all azimuths.
  const Quadrature rings = sphere_quadrature(0, points);
  LineQuadrature line;
  for (int ring = 0; ring < points; ++ring) {
    const std::size_t first = std::size_t(ring) * 2 * std::size_t(points);
    line.nodes.push_back(rings.directions[first].z);
    line.weights.push_back(rings.weights[first] * 2 * points / (2 * portable::kPi));
  }
  return line;
}

Quadrature sphere_cell_quadrature(int points) {
  std::vector<Polygon> cells;
  for (int octant = 0; octant < 8; ++octant) {
    const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
    cells.push_back({{x, 0, 0}, {0, y, 0}, {0, 0, z}});
  }
  for (const glm::dvec3& plane : cutting_planes()) {
    std::vector<Polygon> parts;
    for (const Polygon& cell : cells)
      for (const double side : {1.0, -1.0})
        if (auto part = half_of(cell, plane, side)) parts.push_back(std::move(*part));
    cells = std::move(parts);
  }

  const LineQuadrature line = line_quadrature(points);
  Quadrature out;
  for (const Polygon& cell : cells)
    for (std::size_t corner = 2; corner < cell.size(); ++corner) {
      const glm::dvec3 &a = cell[0], &b = cell[corner - 1], &c = cell[corner];
      const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
      for (std::size_t i = 0; i < line.nodes.size(); ++i)
        for (std::size_t k = 0; k < line.nodes.size(); ++k) {
          const double u = line.nodes[i], v = line.nodes[k];
          const glm::dvec3 p = a * (1 - u) + (b * (1 - v) + c * v) * u;
          const double length = std::sqrt(glm::dot(p, p));
          out.directions.push_back(p / length);
          out.weights.push_back(line.weights[i] * line.weights[k] * u * volume / (length * length * length));
        }
    }
  return out;
}

}  // namespace twinshade
