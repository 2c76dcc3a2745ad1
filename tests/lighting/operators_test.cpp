#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "lighting/linear_bases.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

using std::numbers::pi;

TEST_CASE("quadrature integrates polynomials of the hemisphere and the sphere") {
  for (const double z_low : {0.0, -1.0}) {
    const Quadrature q = sphere_quadrature(z_low, 24);
    double one = 0, z5 = 0, x2y2 = 0, x6 = 0;
    for (std::size_t i = 0; i < q.weights.size(); ++i) {
      const glm::dvec3& d = q.directions[i];
      one += q.weights[i];
      z5 += q.weights[i] * std::pow(d.z, 5);
      x2y2 += q.weights[i] * d.x * d.x * d.y * d.y;
      x6 += q.weights[i] * std::pow(d.x, 6);
    }
    const double share = z_low < 0 ? 2 : 1;
    CHECK(one == doctest::Approx(2 * pi * share).epsilon(1e-13));
    CHECK(z5 == doctest::Approx(z_low < 0 ? 0 : pi / 3).epsilon(1e-13));
    CHECK(x2y2 == doctest::Approx(2 * pi / 15 * share).epsilon(1e-13));
    CHECK(x6 == doctest::Approx(2 * pi / 7 * share).epsilon(1e-13));
  }
}

TEST_CASE("radiance basis: orthonormal on the sphere, signs of the convention") {
  const Quadrature q = sphere_quadrature(-1, 12);
  const std::vector<double> y = radiance_basis(q.directions);
  for (int i = 0; i < kRadianceCount; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = 0;
      for (std::size_t p = 0; p < q.weights.size(); ++p)
        sum += q.weights[p] * y[p * kRadianceCount + i] * y[p * kRadianceCount + j];
      CAPTURE(i);
      CAPTURE(j);
      CHECK(std::abs(sum - (i == j)) < 1e-6);
    }
  // Signs with the factor (-1)^m, at x, y, z > 0 where they are those of the leading monomial
  const glm::dvec3 d = glm::normalize(glm::dvec3(0.2, 0.1, 3));
  const std::vector<double> v = radiance_basis({&d, 1});
  const int negative[] = {1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23};
  for (const int i : negative) CHECK(v[i] < 0);
  for (const int i : {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22}) CHECK(v[i] > 0);
}

// Entries of T_h in closed form (function of H, spherical harmonic, value), all others zero: l <= 2 are EINM eq. 14, l
// = 3 and 4 by the same integral.
struct Entry {
  int row, column;
  double value;
};
const Entry kTh[] = {
    {0, 0, std::sqrt(2.0) / 2},     {0, 2, std::sqrt(6.0) / 4},       {0, 12, -std::sqrt(14.0) / 16},
    {1, 1, std::sqrt(2.0) / 2},     {1, 5, 3 * std::sqrt(10.0) / 16}, {1, 19, -std::sqrt(15.0) / 16},
    {2, 2, std::sqrt(2.0) / 4},     {2, 6, std::sqrt(30.0) / 8},      {2, 12, std::sqrt(42.0) / 16},
    {2, 20, -std::sqrt(6.0) / 16},  {3, 3, std::sqrt(2.0) / 2},       {3, 7, 3 * std::sqrt(10.0) / 16},
    {3, 21, -std::sqrt(15.0) / 16}, {4, 4, std::sqrt(2.0) / 2},       {4, 10, 5 * std::sqrt(14.0) / 32},
    {5, 8, std::sqrt(2.0) / 2},     {5, 14, 5 * std::sqrt(14.0) / 32}};

TEST_CASE("the operator of H4 and H6 is T_h times the cosine's factors") {
  const double factors[] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24};
  for (const char* name : {"h4", "h6"}) {
    const TechniqueInfo& basis = find_technique(name);
    const std::vector<double> matrix = operator_from_radiance(basis);
    REQUIRE(matrix.size() == std::size_t(basis.count) * kRadianceCount);
    for (int row = 0; row < basis.count; ++row)
      for (int column = 0; column < kRadianceCount; ++column) {
        double expected = 0;
        for (const Entry& e : kTh)
          if (e.row == row && e.column == column) expected = e.value * factors[int(std::sqrt(column))];
        CAPTURE(name);
        CAPTURE(row);
        CAPTURE(column);
        CHECK(std::abs(matrix[std::size_t(row) * kRadianceCount + column] - expected) < 1e-6);
      }
  }
}

TEST_CASE("plain spherical harmonics are truncated, not fitted") {
  const double factors[] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24};
  for (const char* name : {"sh2", "sh3", "sh5"}) {
    const TechniqueInfo& basis = find_technique(name);
    const std::vector<double> matrix = operator_from_radiance(basis);
    for (int row = 0; row < basis.count; ++row)
      for (int column = 0; column < kRadianceCount; ++column)
        CHECK(std::abs(matrix[std::size_t(row) * kRadianceCount + column] -
                       (row == column ? factors[int(std::sqrt(column))] : 0)) < 1e-6);
  }
}

TEST_CASE("every linear basis gives a constant sky over open ground the light that its own fit of pi (1 + z) / 2 has") {
  // Radiance 1 above the horizon in closed form: integral of Y_l0 over the upper hemisphere, 0 for m != 0. Irradiance
  // of a half-lit sphere at normal n is pi (1 + z) / 2.
  std::vector<double> sky(kRadianceCount, 0.0);
  sky[0] = std::sqrt(pi);                           // 2 pi sqrt(1/4pi)
  sky[2] = std::sqrt(3 * pi) / 2;                   // 2 pi sqrt(3/4pi) / 2
  sky[12] = -2 * pi * std::sqrt(7 / (4 * pi)) / 8;  // integral of P_3 over [0, 1] is -1/8
  const Quadrature q = sphere_quadrature(0, 24);
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis || !basis.linear || basis.domain == Domain::sphere) continue;
    if (basis.projection != Projection::least_squares && basis.projection != Projection::truncation &&
        basis.projection != Projection::value_at_normal)
      continue;
    CAPTURE(std::string(basis.name));
    const std::vector<double> matrix = operator_from_radiance(basis);
    const std::vector<double> values = basis_values(basis, q.directions);
    std::vector<double> coefficients(basis.count, 0.0);
    for (int i = 0; i < basis.count; ++i)
      for (int j = 0; j < kRadianceCount; ++j) coefficients[i] += matrix[std::size_t(i) * kRadianceCount + j] * sky[j];
    if (basis.projection == Projection::value_at_normal) {
      CHECK(coefficients[0] == doctest::Approx(pi).epsilon(1e-6));
      continue;
    }
    // Least squares: the error is orthogonal to every function of the basis (truncation: linear functions are exact)
    std::vector<double> moment(basis.count, 0.0);
    double worst = 0;
    for (std::size_t p = 0; p < q.weights.size(); ++p) {
      double error = -pi * (1 + q.directions[p].z) / 2;
      for (int i = 0; i < basis.count; ++i) error += coefficients[i] * values[p * basis.count + i];
      worst = std::max(worst, std::abs(error));
      for (int i = 0; i < basis.count; ++i) moment[i] += q.weights[p] * error * values[p * basis.count + i];
    }
    for (const double m : moment) CHECK(std::abs(m) < 1e-5);
    // These lack the constant, or z
    if (basis.name != "hl2" && basis.name != "directional_occlusion" && basis.name != "zernike3") CHECK(worst < 1e-5);
  }
}

TEST_CASE("a technique that is no linear basis has no operator") {
  CHECK_THROWS_AS(operator_from_radiance(find_technique("facets")), UserError);
}

}  // namespace
}  // namespace twinshade
