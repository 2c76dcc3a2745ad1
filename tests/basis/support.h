// What the tests of bases share: quadratures, evaluation of a basis from its GLSL, and an icosahedron written down
// independently of shaders/basis/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"
#include "lighting/registry.h"

namespace twinshade::test {

constexpr double kPi = 3.14159265358979323846;

struct Points {
  std::vector<glm::dvec3> directions;
  std::vector<double> weights;  // sum: the solid angle
};

// Gauss-Legendre nodes and weights on [0, 1].
struct Nodes {
  std::vector<double> x, weight;
};
Nodes gauss_legendre(int count);

// Gauss-Legendre in z over [z_low, 1], equal steps in azimuth.
Points rings(double z_low, int count);

// Over the 120 triangles that the mirror planes of the icosahedron cut the sphere into, each into splits^2, nodes^2
// points each: exact for smooth functions of each face, and of each octant.
Points icosahedral(int nodes, int splits = 1);

// Row-major [direction][function], in double from the basis' GLSL unless said otherwise.
std::vector<double> values(std::string_view basis, const std::vector<glm::dvec3>& directions,
                           Number number = Number::float64);

struct Irradiance {
  std::vector<glm::dvec3> rgb;
  std::vector<int> reads;
};
// The same coefficients for all directions.
Irradiance irradiance(std::string_view basis, const std::vector<glm::dvec3>& coefficients,
                      const std::vector<glm::dvec3>& directions, Number number = Number::float64);

// Integrals of products of the functions of two bases, row-major.
std::vector<double> products(std::string_view a, std::string_view b, const Points& points);

// Deterministic, in [low, high).
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
  double operator()(double low = -1, double high = 1);
  // Uniform on the sphere, rounded to float.
  glm::dvec3 direction();

 private:
  std::uint64_t state_;
};
std::vector<glm::dvec3> random_vectors(int count, std::uint64_t seed);

struct Frame {
  glm::dvec3 v, e1, e2;
};
// Vertices in the paper's order, with tangent frames.
const std::array<Frame, 12>& icosahedron();
// Its 20 faces: vertices that are all neighbours.
const std::vector<std::array<int, 3>>& icosahedron_faces();
// Spherical barycentric coordinates: n = sum of them times the vertices.
glm::dvec3 barycentric(const std::array<int, 3>& face, const glm::dvec3& n);

// "(0x1.8p+0, ...)"
std::string hex(const glm::dvec3& v);

// All bases that are linear, or all that are not.
std::vector<const TechniqueInfo*> bases(bool linear);

// The component that is largest in absolute value.
inline double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace twinshade::test
