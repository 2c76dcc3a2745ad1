// Nodes by Newton's method on the Legendre polynomial from Tricomi's first guess (Davis and Rabinowitz, Methods of
// Numerical Integration, section 2.7).
#include "lighting/quadrature.h"

#include <cmath>

#include "base/error.h"
#include "base/portable_math.h"

namespace twinshade {
namespace {

struct Node {
  double x, weight;  // of [-1, 1]
};

std::vector<Node> gauss_legendre(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = portable::cos(portable::kPi * (i + 0.75) / (count + 0.5)), slope = 0;
    for (int step = 0; step < 8; ++step) {
      double before = 1, value = x;  // P_0, P_1
      for (int k = 2; k <= count; ++k) {
        const double after = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = after;
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

// One ring of height z, whose points share `weight`.
void add_ring(Quadrature& out, double z, double weight, int spokes) {
  const double radius = std::sqrt(1 - z * z);
  for (int spoke = 0; spoke < spokes; ++spoke) {
    const double angle = 2 * portable::kPi * (spoke + 0.5) / spokes;
    out.directions.push_back({radius * portable::cos(angle), radius * portable::sin(angle), z});
    out.weights.push_back(weight * 2 * portable::kPi / spokes);
  }
}

// The spherical triangle apex, a, b: (u, v) of [0, 1]^2 to the point apex + u ((a - apex) + v (b - a)) of the flat one.
void add_cell(Quadrature& out, const std::vector<Node>& nodes, const glm::dvec3& apex, const glm::dvec3& a,
              const glm::dvec3& b) {
  const double volume = std::abs(glm::dot(apex, glm::cross(a, b)));
  for (const Node& along : nodes) {
    const double u = (along.x + 1) / 2;
    for (const Node& across : nodes) {
      const double v = (across.x + 1) / 2;
      const glm::dvec3 p = apex + ((a - apex) + (b - a) * v) * u;
      const double length = std::sqrt(glm::dot(p, p));
      out.directions.push_back(p / length);
      out.weights.push_back(along.weight * across.weight * 0.25 * u * volume / (length * length * length));
    }
  }
}

}  // namespace

Quadrature sphere_quadrature(double z_low, int rings) {
  Quadrature out;
  for (const Node& node : gauss_legendre(rings)) {
    const double half = (1 - z_low) / 2;
    add_ring(out, z_low + half * (node.x + 1), half * node.weight, 2 * rings);
  }
  return out;
}

Quadrature hemisphere_quadrature(int rings) {
  Quadrature out;
  for (const Node& node : gauss_legendre(rings)) {
    const double root = (node.x + 1) / 2;
    add_ring(out, root * root, root * node.weight, 2 * rings);
  }
  return out;
}

std::vector<glm::dvec3> icosahedron_vertices() {
  const double ratio = (1 + std::sqrt(5.0)) / 2;
  std::vector<glm::dvec3> vertices;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {1.0, -1.0})
      for (const double phi : {ratio, -ratio}) {
        glm::dvec3 v(0);
        v[(axis + 1) % 3] = phi;
        v[(axis + 2) % 3] = one;
        vertices.push_back(unit(v));
      }
  return vertices;
}

Quadrature icosahedral_quadrature(int points) {
  const std::vector<Node> nodes = gauss_legendre(points);
  const std::vector<glm::dvec3> vertices = icosahedron_vertices();
  const auto adjacent = [&](std::size_t i, std::size_t j) { return glm::dot(vertices[i], vertices[j]) > 0.4; };

  // Each face in six by its medians. The horizons of the vertices run through the middles of the edges, and cut each
  // sixth in two between its edge and the median from its vertex.
  Quadrature out;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = i + 1; j < 12; ++j)
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(i, k)) continue;
        const glm::dvec3 corner[3] = {vertices[i], vertices[j], vertices[k]};
        const glm::dvec3 centre = unit((corner[0] + corner[1]) + corner[2]);
        for (int c = 0; c < 3; ++c) {
          const glm::dvec3 middle[2] = {unit(corner[c] + corner[(c + 1) % 3]), unit(corner[c] + corner[(c + 2) % 3])};
          const glm::dvec3 between = unit(middle[0] + middle[1]);
          for (const glm::dvec3& edge : middle) {
            add_cell(out, nodes, corner[c], edge, between);
            add_cell(out, nodes, centre, edge, between);
          }
        }
      }
  TWINSHADE_CHECK_EQ(out.weights.size(), std::size_t(240) * points * points);
  return out;
}

const Quadrature& domain_quadrature(Domain domain) {
  // Far beyond the degrees in use
  static const Quadrature hemisphere = hemisphere_quadrature(48), sphere = icosahedral_quadrature(8);
  return domain == Domain::hemisphere ? hemisphere : sphere;
}

}  // namespace twinshade
