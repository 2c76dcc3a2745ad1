#include "lighting/projection.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "lighting/linear_bases.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

using std::numbers::pi;

std::vector<double> random_radiance(int trial, int count, int lit) {
  std::vector<double> radiance(std::size_t(count) * 3, 0.0);
  for (int i = 0; i < lit * 3; ++i) radiance[i] = 2 * unit_real(random_bits(11, 0, trial, i)) - 1;
  return radiance;
}

// Irradiance of SH radiance, l <= 4.
std::vector<double> irradiance(const std::vector<double>& radiance, const std::vector<glm::dvec3>& directions) {
  const std::vector<double> y = radiance_basis(directions);
  const auto cosine = clamped_cosine_factors();
  std::vector<double> e(directions.size() * 3, 0.0);
  for (std::size_t p = 0; p < directions.size(); ++p)
    for (int j = 0; j < kRadianceCount; ++j)
      for (int c = 0; c < 3; ++c) e[p * 3 + c] += y[p * kRadianceCount + j] * cosine[j] * radiance[j * 3 + c];
  return e;
}

TEST_CASE("quadratures integrate: octants, polynomials, half powers of z, the truncated cosine") {
  const Quadrature& sphere = domain_quadrature(Domain::sphere);
  double total = 0, octant = 0, x4y2 = 0, z10 = 0;
  const glm::dvec3 vertex = glm::normalize(glm::dvec3(0, (1 + std::sqrt(5.0)) / 2, 1));
  double lobe = 0;
  for (std::size_t p = 0; p < sphere.weights.size(); ++p) {
    const glm::dvec3& d = sphere.directions[p];
    const double w = sphere.weights[p];
    total += w;
    if (d.x > 0 && d.y > 0 && d.z > 0) octant += w;
    x4y2 += w * std::pow(d.x, 4) * d.y * d.y;
    z10 += w * std::pow(d.z, 10);
    lobe += w * std::max(0.0, glm::dot(d, vertex));
  }
  CHECK(total == doctest::Approx(4 * pi).epsilon(1e-13));
  CHECK(octant == doctest::Approx(pi / 2).epsilon(1e-13));
  CHECK(x4y2 == doctest::Approx(4 * pi / 35).epsilon(1e-10));
  CHECK(z10 == doctest::Approx(4 * pi / 11).epsilon(1e-10));
  CHECK(lobe == doctest::Approx(pi).epsilon(1e-12));

  const Quadrature& hemisphere = domain_quadrature(Domain::hemisphere);
  double roots = 0;
  for (std::size_t p = 0; p < hemisphere.weights.size(); ++p)
    roots += hemisphere.weights[p] * std::sqrt(hemisphere.directions[p].z);
  CHECK(roots == doctest::Approx(4 * pi / 3).epsilon(1e-13));
}

TEST_CASE("projected light comes back: truncation and least squares of what the basis can represent") {
  const Quadrature points = sphere_quadrature(-1, 12);
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis || !basis.linear || basis.projection != Projection::truncation) continue;
    CAPTURE(std::string(basis.name));
    for (const int count : {25, 36}) {
      const std::vector<double> radiance = random_radiance(1, count, std::min(basis.count, 25));
      std::vector<double> coefficients(basis.count * 3);
      Projector(basis, count).project(radiance.data(), coefficients.data());
      const std::vector<double> back = reconstruct(basis, coefficients, points.directions);
      const std::vector<double> expected = irradiance(radiance, points.directions);
      for (std::size_t i = 0; i < back.size(); ++i) CHECK(std::abs(back[i] - expected[i]) < 1e-6);

      const std::vector<double> fitted =
          SampleProjector(basis, points.directions, points.weights).project(expected, {});
      for (std::size_t i = 0; i < fitted.size(); ++i) CHECK(std::abs(fitted[i] - coefficients[i]) < 1e-6);
    }
  }
}

TEST_CASE("many cells at once are projected as one by one") {
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis) continue;
    CAPTURE(std::string(basis.name));
    const Projector projector(basis, 25);
    const std::size_t length = std::size_t(basis.count) * 3;
    std::vector<double> radiance, together(3 * length), alone(length);
    for (int cell = 0; cell < 3; ++cell) {
      std::vector<double> one = random_radiance(cell, 25, 25);
      for (int c = 0; c < 3; ++c) one[c] += 4;
      radiance.insert(radiance.end(), one.begin(), one.end());
    }
    projector.project(radiance.data(), together.data(), 3);
    for (std::size_t cell = 0; cell < 3; ++cell) {
      projector.project(radiance.data() + cell * 75, alone.data());
      for (std::size_t i = 0; i < length; ++i) CHECK(alone[i] == together[cell * length + i]);
    }
  }
}

TEST_CASE("every basis: no light gives finite coefficients and no light back") {
  const Quadrature points = sphere_quadrature(0, 6);
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis) continue;
    CAPTURE(std::string(basis.name));
    for (const int count : {25, 36}) {
      const std::vector<double> radiance(std::size_t(count) * 3, 0.0);
      std::vector<double> coefficients(std::size_t(basis.count) * 3, 7.0);
      Projector(basis, count).project(radiance.data(), coefficients.data());
      for (const double value : coefficients) CHECK(std::isfinite(value));
      for (const double value : reconstruct(basis, coefficients, points.directions)) CHECK(value == 0);
    }
  }
}

TEST_CASE("H through T_h is the direct projection where the signal has only l <= 2") {
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis || basis.projection != Projection::through_sh3) continue;
    CAPTURE(std::string(basis.name));
    const TechniqueInfo& direct = find_technique(basis.count == 4 ? "h4" : "h6");
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<double> radiance = random_radiance(trial, 25, 9);
      std::vector<double> through(18), straight(18);
      Projector(basis, 25).project(radiance.data(), through.data());
      Projector(direct, 25).project(radiance.data(), straight.data());
      for (int i = 0; i < direct.count * 3; ++i) CHECK(std::abs(through[i] - straight[i]) < 1e-6);
    }
  }
}

TEST_CASE("operators between bases: there and back is the identity; SH to H is T_h") {
  const TechniqueInfo &sh3 = find_technique("sh3"), &sh5 = find_technique("sh5"), &h6 = find_technique("h6");
  const std::vector<double> up = basis_operator(sh3, sh5), down = basis_operator(sh5, sh3);
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 9; ++k) {
      double sum = 0;
      for (int j = 0; j < 25; ++j) sum += down[i * 25 + j] * up[j * 9 + k];
      CHECK(std::abs(sum - (i == k)) < 1e-6);
    }
  const std::vector<double> th = basis_operator(sh5, h6);
  CHECK(std::abs(th[0] - std::sqrt(0.5)) < 1e-6);
  CHECK(std::abs(th[5 * 25 + 14] - 5 * std::sqrt(14.0) / 32) < 1e-6);
  CHECK(std::abs(th[1 * 25 + 19] + std::sqrt(15.0) / 16) < 1e-6);
}

TEST_CASE("Gram matrices: H and HL2 are orthonormal; SH on the hemisphere is conditioned as it must be") {
  for (const char* name : {"h4", "h6", "hl2"}) {
    const TechniqueInfo& basis = find_technique(name);
    const std::vector<double> gram = gram_matrix(basis);
    for (int i = 0; i < basis.count; ++i)
      for (int j = 0; j < basis.count; ++j) CHECK(std::abs(gram[i * basis.count + j] - (i == j)) < 1e-6);
  }
  const auto condition = [](const char* name) {
    const TechniqueInfo& basis = find_technique(name);
    return condition_number(gram_matrix(basis, Domain::hemisphere), basis.count);
  };
  CHECK(condition("sh2") == doctest::Approx(13.9).epsilon(0.005));
  CHECK(condition("sh3") == doctest::Approx(254).epsilon(0.005));
  CHECK(condition("sh5") == doctest::Approx(1.5e5).epsilon(0.05));
  CHECK(std::isinf(condition_number(std::vector<double>{1, 1, 1, 1}, 2)));
}

TEST_CASE(
    "irradiance from radiance within a basis: SH gets the cosine's factors, moments need the inverse Gram matrix") {
  const TechniqueInfo& sh3 = find_technique("sh3");
  const std::vector<double> on_coefficients = irradiance_from_coefficients(sh3),
                            on_moments = irradiance_from_moments(sh3);
  const double factors[] = {pi, 2 * pi / 3, pi / 4};
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      const double expected = i == j ? factors[i == 0 ? 0 : i < 4 ? 1 : 2] : 0;
      CHECK(std::abs(on_coefficients[i * 9 + j] - expected) < 1e-4);
      CHECK(std::abs(on_moments[i * 9 + j] - expected) < 1e-4);
    }
}

TEST_CASE("what cannot be projected is refused") {
  const TechniqueInfo& sh3 = find_technique("sh3");
  CHECK_THROWS_AS(Projector(find_technique("facets"), 25), UserError);
  CHECK_THROWS_AS(Projector(sh3, 24), UserError);
  CHECK_THROWS_AS(gram_matrix(find_technique("facets")), UserError);
  const std::vector<double> weights(20, 1.0);
  std::vector<glm::dvec3> directions(20, glm::dvec3(0, 0, 1));
  CHECK_THROWS_WITH_AS(SampleProjector(sh3, directions, weights), doctest::Contains("too few"), UserError);
  const Quadrature points = sphere_quadrature(-1, 8);
  directions = points.directions;
  directions[3] = glm::dvec3(0);
  CHECK_THROWS_WITH_AS(SampleProjector(sh3, directions, points.weights), doctest::Contains("direction 3"), UserError);
  directions[3] = glm::dvec3(NAN, 0, 0);
  CHECK_THROWS_AS(SampleProjector(sh3, directions, points.weights), UserError);
  const SampleProjector good(sh3, points.directions, points.weights);
  std::vector<double> samples(points.weights.size() * 3, 1.0);
  samples[7] = INFINITY;
  CHECK_THROWS_WITH_AS(good.project(samples, {}), doctest::Contains("sample 2"), UserError);
  CHECK_THROWS_AS(good.project({}, {}), UserError);
}

}  // namespace
}  // namespace twinshade
