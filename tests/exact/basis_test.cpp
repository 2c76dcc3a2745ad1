// The bases as functions, evaluated in double from their GLSL: orthonormality by quadrature, the matrix T_h of Habel
// and Wimmer (I3D 2010, eq. 14 and appendix A), the sign convention of spherical harmonics, and irradiance as the sum
// of its terms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "cpu_shaders/load/host_eval.h"
#include "tests/exact/shader_rows.h"

namespace twinshade::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Constants are rounded to float: 2^-24 relative in each factor.
constexpr double kTolerance = 3e-7;

struct Quadrature {
  std::vector<double> directions;  // x y z
  std::vector<double> weights;     // sum: the solid angle
};

// Gauss-Legendre in z over [low, 1], equal steps in azimuth: exact for polynomials up to degree 20.
Quadrature quadrature(double low) {
  constexpr int kNodes = 12, kAzimuths = 24;
  Quadrature made;
  for (int i = 0; i < kNodes; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (kNodes + 0.5)), derivative = 0;
    for (int step = 0; step < 20; ++step) {
      double previous = 1, value = x;
      for (int k = 2; k <= kNodes; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      derivative = kNodes * (x * value - previous) / (x * x - 1);
      x -= value / derivative;
    }
    const double weight = 2 / ((1 - x * x) * derivative * derivative);
    const double z = low + (1 - low) * 0.5 * (x + 1), radius = std::sqrt(1 - z * z);
    for (int j = 0; j < kAzimuths; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / kAzimuths;
      made.directions.insert(made.directions.end(), {radius * std::cos(phi), radius * std::sin(phi), z});
      made.weights.push_back(weight * (1 - low) * 0.5 * 2 * kPi / kAzimuths);
    }
  }
  return made;
}

// Integrals of all products of two bases' functions, row-major.
std::vector<double> products(const std::string& a, const std::string& b, const Quadrature& q) {
  const std::vector<double> va = evaluate_basis(a, q.directions), vb = evaluate_basis(b, q.directions);
  const std::size_t rows = q.weights.size(), na = va.size() / rows, nb = vb.size() / rows;
  std::vector<double> result(na * nb);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = 0; i < na; ++i)
      for (std::size_t j = 0; j < nb; ++j) result[i * nb + j] += q.weights[r] * va[r * na + i] * vb[r * nb + j];
  return result;
}

void check_identity(const std::string& basis, const Quadrature& q, std::size_t count) {
  CAPTURE(basis);
  const std::vector<double> gram = products(basis, basis, q);
  REQUIRE(gram.size() == count * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      CHECK(std::fabs(gram[i * count + j] - (i == j ? 1 : 0)) < kTolerance);
    }
}

}  // namespace

TEST_CASE("hemisphere bases are orthonormal on the hemisphere") {
  const Quadrature q = quadrature(0);
  check_identity("hl2", q, 3);
  check_identity("directional_occlusion", q, 3);
  check_identity("h4", q, 4);
  check_identity("h6", q, 6);
}

TEST_CASE("spherical harmonics are orthonormal on the sphere") {
  const Quadrature q = quadrature(-1);
  check_identity("sh2", q, 4);
  check_identity("sh3", q, 9);
  check_identity("sh5", q, 25);
}

TEST_CASE("products of the H-basis and spherical harmonics on the hemisphere are T_h, signs included") {
  // (row H, column Y): the entries that are not zero, l <= 4
  struct Entry {
    std::size_t h, y;
    double value;
  };
  const double r2 = std::sqrt(2.0), r6 = std::sqrt(6.0), r10 = std::sqrt(10.0), r14 = std::sqrt(14.0);
  const std::vector<Entry> entries = {{0, 0, r2 / 2},
                                      {0, 2, r6 / 4},
                                      {0, 12, -r14 / 16},
                                      {1, 1, r2 / 2},
                                      {1, 5, 3 * r10 / 16},
                                      {1, 19, -std::sqrt(15.0) / 16},
                                      {2, 2, r2 / 4},
                                      {2, 6, std::sqrt(30.0) / 8},
                                      {2, 12, std::sqrt(42.0) / 16},
                                      {2, 20, -r6 / 16},
                                      {3, 3, r2 / 2},
                                      {3, 7, 3 * r10 / 16},
                                      {3, 21, -std::sqrt(15.0) / 16},
                                      {4, 4, r2 / 2},
                                      {4, 10, 5 * r14 / 32},
                                      {5, 8, r2 / 2},
                                      {5, 14, 5 * r14 / 32}};
  std::vector<double> expected(6 * 25);
  for (const Entry& entry : entries) expected[entry.h * 25 + entry.y] = entry.value;
  const std::vector<double> computed = products("h6", "sh5", quadrature(0));
  REQUIRE(computed.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i / 25);
    CAPTURE(i % 25);
    CHECK(std::fabs(computed[i] - expected[i]) < kTolerance);
  }
}

TEST_CASE("H4 is the beginning of H6, lower orders the beginning of higher ones") {
  const Quadrature q = quadrature(0);
  const std::vector<double> h4 = evaluate_basis("h4", q.directions), h6 = evaluate_basis("h6", q.directions);
  const std::vector<double> sh2 = evaluate_basis("sh2", q.directions), sh3 = evaluate_basis("sh3", q.directions);
  for (std::size_t r = 0; r < q.weights.size(); ++r)
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(h4[r * 4 + i] == h6[r * 6 + i]);
      CHECK(sh2[r * 4 + i] == sh3[r * 9 + i]);
    }
}

TEST_CASE("spherical harmonics have the factor (-1)^m") {
  const double x = 0.36, y = 0.48, z = 0.8;
  const std::vector<double> value = evaluate_basis("sh3", {x, y, z});
  const auto root = [](double a, double b) { return std::sqrt(a / (b * kPi)); };
  const std::array<double, 9> expected = {root(1, 4),
                                          -root(3, 4) * y,
                                          root(3, 4) * z,
                                          -root(3, 4) * x,
                                          root(15, 4) * x * y,
                                          -root(15, 4) * y * z,
                                          root(5, 16) * (3 * z * z - 1),
                                          -root(15, 4) * x * z,
                                          root(15, 16) * (x * x - y * y)};
  for (std::size_t i = 0; i < 9; ++i) {
    CAPTURE(i);
    CHECK(std::fabs(value[i] - expected[i]) < kTolerance);
  }
}

TEST_CASE("the Half-Life 2 basis is the cosine to its three directions") {
  const double a = 1 / std::sqrt(6.0), b = 1 / std::sqrt(2.0), c = 1 / std::sqrt(3.0);
  const std::array<std::array<double, 3>, 3> axes = {{{-a, -b, c}, {-a, b, c}, {2 * a, 0, c}}};
  std::vector<double> directions;
  for (const auto& axis : axes) directions.insert(directions.end(), axis.begin(), axis.end());
  const std::vector<double> value = evaluate_basis("hl2", directions);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      CHECK(std::fabs(value[i * 3 + j] - (i == j ? std::sqrt(3 / (2 * kPi)) : 0)) < kTolerance);
}

TEST_CASE("directional occlusion spans what the Half-Life 2 basis spans") {
  const Quadrature q = quadrature(0);
  const std::vector<double> change = products("hl2", "directional_occlusion", q);  // a rotation, if they do
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += change[i * 3 + k] * change[j * 3 + k];
      CHECK(std::fabs(dot - (i == j ? 1 : 0)) < 3 * kTolerance);
    }
}

TEST_CASE("irradiance is the sum of coefficients times basis values") {
  for (const char* file : {"lightmap", "half_life2", "directional_occlusion", "h4", "h6", "sh2", "sh3"}) {
    const RowShader shader(std::string("irradiance_") + file,
                           std::string("in vec3 n;\nin vec3 stored[9];\n#define COEF(i) stored[i]\n#include \"basis/") +
                               file +
                               ".glsl\"\n"
                               "layout(location = 0) out vec3 direct;\nlayout(location = 1) out vec3 summed;\n"
                               "void main() {\n  direct = basis_irradiance(n);\n"
                               "  precise vec3 sum = stored[0] * basis_value(0, n);\n"
                               "  for (int i = 1; i < BASIS_COUNT; ++i) sum += stored[i] * basis_value(i, n);\n"
                               "  summed = sum;\n}\n",
                           Number::scalar);
    Random random(9);
    constexpr std::size_t kRows = 256;
    std::vector<float> inputs(30 * kRows);
    for (float& value : inputs) value = random.uniform(-1, 1);
    const std::vector<float> outputs = shader.run(inputs, kRows);
    for (std::size_t i = 0; i < 3 * kRows; ++i) {
      CAPTURE(file);
      CHECK(std::fabs(outputs[i] - outputs[3 * kRows + i]) < 2e-6f);
    }
  }
}

}  // namespace twinshade::test
