// Ambient Dice: which triangle, what the patches reproduce, and that spherical patches join with a continuous gradient.
// Iwanicki and Sloan, Ambient Dice, EGSR 2017.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/basis/support.h"

namespace twinshade::test {
namespace {

// Coefficients of Bezier patches for the linear function a . n + constant.
std::vector<glm::dvec3> linear_coefficients(const glm::dvec3& a, double constant) {
  std::vector<glm::dvec3> coefficients;
  for (const Frame& frame : icosahedron()) {
    coefficients.emplace_back(glm::dot(a, frame.v) + constant);
    coefficients.emplace_back(glm::dot(a, frame.e1));
    coefficients.emplace_back(glm::dot(a, frame.e2));
  }
  return coefficients;
}

std::vector<glm::dvec3> random_directions(int count, std::uint64_t seed) {
  Uniform uniform(seed);
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i) directions.push_back(uniform.direction());
  return directions;
}

// Derivative at n along `tangent` (unit, perpendicular to n), extrapolated from values on that side only: of a cubic
// through points at 1, 2, 3 and 4 steps.
glm::dvec3 one_sided_slope(const char* basis, const std::vector<glm::dvec3>& coefficients, const glm::dvec3& n,
                           const glm::dvec3& tangent) {
  constexpr double kStep = 1e-4;
  std::vector<glm::dvec3> directions;
  for (int i = 1; i <= 4; ++i) directions.push_back(std::cos(i * kStep) * n + std::sin(i * kStep) * tangent);
  const std::vector<glm::dvec3> f = irradiance(basis, coefficients, directions).rgb;
  return (-26.0 * f[0] + 57.0 * f[1] - 42.0 * f[2] + 11.0 * f[3]) / (6 * kStep);
}

// The largest jump of the derivative across the 30 edges, at points between their ends.
double worst_kink(const char* basis, const std::vector<glm::dvec3>& coefficients) {
  double worst = 0;
  int edges = 0;
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j) {
      const glm::dvec3 a = icosahedron()[i].v, b = icosahedron()[j].v;
      if (glm::dot(a, b) < 0.4) continue;
      ++edges;
      const glm::dvec3 across = glm::normalize(glm::cross(a, b));
      for (const double share : {0.01, 0.2, 0.37, 0.5, 0.8, 0.99}) {
        const glm::dvec3 n = glm::normalize((1 - share) * a + share * b);
        const glm::dvec3 jump =
            one_sided_slope(basis, coefficients, n, across) + one_sided_slope(basis, coefficients, n, -across);
        worst = std::max(worst, largest(jump));
      }
    }
  CHECK(edges == 30);
  return worst;
}

}  // namespace

TEST_CASE("the icosahedron has 12 unit vertices, 20 faces, and tangent frames") {
  CHECK(icosahedron_faces().size() == 20);
  for (int i = 0; i < 12; ++i) {
    const Frame& frame = icosahedron()[i];
    CHECK(glm::length(frame.v) == doctest::Approx(1).epsilon(1e-14));
    CHECK(std::abs(glm::dot(frame.v, frame.e1)) < 1e-15);
    CHECK(glm::length(frame.v + icosahedron()[i ^ 3].v) < 1e-15);
  }
}

TEST_CASE("spherical patches are C1 across all 30 edges; flat and linear ones are not") {
  const std::vector<glm::dvec3> coefficients = random_vectors(36, 3);
  CHECK(worst_kink("ad_spherical", coefficients) < 5e-6);  // constants are float: 6e-8 relative each
  CHECK(worst_kink("ad_flat", coefficients) > 1e-2);
  CHECK(worst_kink("ad_linear_spherical", {coefficients.begin(), coefficients.begin() + 12}) > 1e-1);
}

TEST_CASE("values at the 12 vertices are coefficients; of spherical patches gradients too, from every side") {
  const std::vector<glm::dvec3> coefficients = random_vectors(36, 4);
  for (const char* basis : {"ad_spherical", "ad_flat"})
    for (int i = 0; i < 12; ++i) {
      CAPTURE(basis);
      CAPTURE(i);
      const Frame& frame = icosahedron()[i];
      const glm::dvec3 value = irradiance(basis, coefficients, {frame.v}).rgb[0];
      CHECK(largest(value - coefficients[3 * i]) < 1e-6);
      if (basis == std::string("ad_flat")) continue;
      for (int k = 0; k < 20; ++k) {  // 5 triangles meet: four directions in each, edges among them
        const double angle = 2 * kPi * k / 20;
        const glm::dvec3 tangent = std::cos(angle) * frame.e1 + std::sin(angle) * frame.e2;
        const glm::dvec3 expected =
            coefficients[3 * i + 1] * std::cos(angle) + coefficients[3 * i + 2] * std::sin(angle);
        CHECK(largest(one_sided_slope(basis, coefficients, frame.v, tangent) - expected) < 1e-6);
      }
    }
}

TEST_CASE("spherical patches and spherical barycentric coordinates reproduce linear functions") {
  const std::vector<glm::dvec3> directions = random_directions(2000, 5);
  const glm::dvec3 a(0.3, -0.8, 0.55);
  const std::vector<glm::dvec3> patches = linear_coefficients(a, 0);
  std::vector<glm::dvec3> at_vertices;
  for (const Frame& frame : icosahedron()) at_vertices.emplace_back(glm::dot(a, frame.v));
  const Irradiance spherical = irradiance("ad_spherical", patches, directions);
  const Irradiance linear = irradiance("ad_linear_spherical", at_vertices, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    CAPTURE(hex(directions[i]));
    CHECK(std::abs(spherical.rgb[i].x - glm::dot(a, directions[i])) < 1e-6);
    CHECK(std::abs(linear.rgb[i].x - glm::dot(a, directions[i])) < 1e-6);
  }
}

TEST_CASE("a constant is exact for flat patches, planar barycentric coordinates and lobes that sum to one") {
  // Of length 1 in double: rounded to float they are off by 1e-7, and lobes are powers of that.
  std::vector<glm::dvec3> directions = random_directions(2000, 6);
  for (glm::dvec3& direction : directions) direction = glm::normalize(direction);
  const std::vector<glm::dvec3> ones(12, glm::dvec3(1)), patches = linear_coefficients(glm::dvec3(0), 1);
  const auto range = [&](const char* basis, const std::vector<glm::dvec3>& coefficients) {
    double low = 1e9, high = -1e9;
    for (const glm::dvec3& e : irradiance(basis, coefficients, directions).rgb) {
      low = std::min(low, e.x);
      high = std::max(high, e.x);
    }
    return std::pair(low, high);
  };
  for (const char* basis : {"ad_linear_planar", "ad_cos2", "ad_cos2cos4"}) {
    CAPTURE(std::string(basis));
    CHECK(range(basis, ones).first > 1 - 2e-7);
    CHECK(range(basis, ones).second < 1 + 2e-7);
  }
  CHECK(range("ad_flat", patches).first > 1 - 2e-7);
  CHECK(range("ad_flat", patches).second < 1 + 2e-7);
  // Spherical patches: 0.93796 to 1 (least at the middle of edges or faces, 1 at vertices)
  CHECK(range("ad_spherical", patches).first > 0.93796);
  CHECK(range("ad_spherical", patches).first < 0.9385);
  CHECK(range("ad_spherical", patches).second < 1 + 2e-7);
  CHECK(range("ad_spherical", patches).second > 0.999);
  CHECK(range("ambient_cube", std::vector<glm::dvec3>(6, glm::dvec3(1))).first > 1 - 2e-7);
}

TEST_CASE("raw lobes are .7 cos^2 + .3 cos^4 about the vertices in front") {
  const std::vector<glm::dvec3> directions = random_directions(500, 7);
  const std::vector<double> raw = values("ad_cos2cos4_raw", directions);
  for (std::size_t r = 0; r < directions.size(); ++r)
    for (int i = 0; i < 12; ++i) {
      const double c = std::max(0.0, glm::dot(directions[r], icosahedron()[i].v)), c2 = c * c;
      CHECK(std::abs(raw[12 * r + i] - (0.7 * c2 + 0.3 * c2 * c2)) < 1e-7);
    }
}

TEST_CASE("YCoCg: luma by spherical patches, chroma linear") {
  const std::vector<glm::dvec3> directions = random_directions(500, 8), packed = random_vectors(24, 9);
  std::vector<glm::dvec3> luma, chroma;
  for (int v = 0; v < 12; ++v) {
    for (int k = 0; k < 3; ++k) luma.emplace_back(packed[v][k]);
    chroma.push_back(packed[12 + v]);
  }
  const Irradiance y = irradiance("ad_spherical", luma, directions);
  const Irradiance c = irradiance("ad_linear_spherical", chroma, directions);
  const Irradiance rgb = irradiance("ad_ycocg", packed, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double co = c.rgb[i].x, cg = c.rgb[i].y;
    const glm::dvec3 expected(y.rgb[i].x + co - cg, y.rgb[i].x + cg, y.rgb[i].x - co - cg);
    CHECK(largest(rgb.rgb[i] - expected) < 1e-14);
    CHECK(std::abs(0.25 * rgb.rgb[i].x + 0.5 * rgb.rgb[i].y + 0.25 * rgb.rgb[i].z - y.rgb[i].x) < 1e-14);
  }
}

}  // namespace twinshade::test
