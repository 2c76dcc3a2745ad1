#include "experiments/sphere_cells.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace twinshade;

namespace {

const double kPi = std::acos(-1.0);

template <class F>
double integral(const Quadrature& points, F&& f) {
  double sum = 0;
  for (std::size_t i = 0; i < points.weights.size(); ++i) sum += points.weights[i] * f(points.directions[i]);
  return sum;
}

}  // namespace

TEST_CASE("cells of the sphere integrate polynomials and kinks along their edges to 5e-12") {
  const Quadrature points = sphere_cell_quadrature(8);
  const double phi = (1 + std::sqrt(5.0)) / 2;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0, 1, phi));
  CHECK(std::abs(integral(points, [](auto&) { return 1.0; }) - 4 * kPi) < 5e-12);
  CHECK(std::abs(integral(points, [](auto& d) { return d.x * d.x * d.y * d.y * d.z * d.z; }) - 4 * kPi / 105) < 5e-12);
  // max(0, cos)^k about an axis of the icosahedron and of the cube: 2 pi / (k + 1)
  CHECK(std::abs(integral(points, [&](auto& d) { return std::max(0.0, glm::dot(axis, d)); }) - kPi) < 5e-12);
  CHECK(std::abs(integral(points, [&](auto& d) { return std::pow(std::max(0.0, glm::dot(axis, d)), 3); }) - kPi / 2) <
        5e-12);
  CHECK(std::abs(integral(points, [&](auto& d) { return std::pow(std::max(0.0, d.y), 3); }) - kPi / 2) < 5e-12);
  for (const double weight : points.weights) CHECK(weight > 0);
}

TEST_CASE("Gauss-Legendre on the line is exact to degree 2n - 1") {
  const LineQuadrature line = line_quadrature(5);
  double sum = 0;
  for (std::size_t i = 0; i < line.nodes.size(); ++i) sum += line.weights[i] * std::pow(line.nodes[i], 9);
  CHECK(std::abs(sum - 0.1) < 1e-15);
}
