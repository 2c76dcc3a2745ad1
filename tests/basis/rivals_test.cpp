// Bases whose irradiance is no sum of coefficients times functions of the normal: ZH3, non-linear L1, AHD; and
// spherical Gaussians.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/basis/support.h"

namespace twinshade::test {
namespace {

const double kY0 = std::sqrt(1 / (4 * kPi));
const double kY1 = std::sqrt(3 / (4 * kPi));

// Irradiance in spherical harmonics l <= 2 of a directional light of irradiance rgb, from direction d.
std::vector<glm::dvec3> light(const glm::dvec3& d, const glm::dvec3& rgb) {
  const double factors[] = {kPi, 2 * kPi / 3, kPi / 4};
  const std::vector<double> y = values("sh3", {d});
  std::vector<glm::dvec3> coefficients;
  for (int i = 0; i < 9; ++i) coefficients.push_back(rgb * (y[i] * factors[i == 0 ? 0 : i < 4 ? 1 : 2]));
  return coefficients;
}

std::vector<glm::dvec3> first(const std::vector<glm::dvec3>& all, int count) {
  return {all.begin(), all.begin() + count};
}

const glm::dvec3 kLight = glm::normalize(glm::dvec3(0.5, -0.3, 0.8));
const glm::dvec3 kColour(1, 0.5, 0.25);

}  // namespace

TEST_CASE("non-linear L1 of a single light is the cube of its half cosine") {
  const Points points = rings(-1, 8);
  const std::vector<glm::dvec3> e = irradiance("l1_nonlinear", first(light(kLight, kColour), 4), points.directions).rgb;
  for (std::size_t i = 0; i < e.size(); ++i) {
    // |R1| = R0 = E/4: p = 3, a = 0
    const double half = (1 + glm::dot(points.directions[i], kLight)) / 2;
    CHECK(largest(e[i] - kColour * (half * half * half)) < 1e-6);
  }
}

TEST_CASE("non-linear L1 keeps the mean, and is never negative") {
  const Points points = rings(-1, 40);
  Uniform uniform(21);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<glm::dvec3> coefficients = random_vectors(4, 100 + repeat);
    coefficients[0] = glm::dvec3(uniform(1.8, 3));  // |c1| <= sqrt3: |R1| <= R0
    glm::dvec3 sum(0);
    const std::vector<glm::dvec3> e = irradiance("l1_nonlinear", coefficients, points.directions).rgb;
    for (std::size_t i = 0; i < e.size(); ++i) {
      sum += points.weights[i] * e[i];
      CHECK(std::min({e[i].x, e[i].y, e[i].z}) >= 0);
    }
    CHECK(largest(sum / (4 * kPi) - coefficients[0] * kY0) < 1e-5);
  }
}

TEST_CASE("ZH3 of a single light is its spherical harmonics l <= 2") {
  const Points points = rings(-1, 8);
  const std::vector<glm::dvec3> all = light(kLight, kColour);
  std::vector<glm::dvec3> coefficients = first(all, 4);
  const std::vector<double> axis = values("sh3", {kLight});
  glm::dvec3 zonal(0);
  for (int i = 4; i < 9; ++i) zonal += all[i] * (axis[i] * std::sqrt(4 * kPi / 5));
  coefficients.push_back(zonal);
  const std::vector<glm::dvec3> expected = irradiance("sh3", all, points.directions).rgb;
  const std::vector<glm::dvec3> e = irradiance("zh3", coefficients, points.directions).rgb;
  for (std::size_t i = 0; i < e.size(); ++i) CHECK(largest(e[i] - expected[i]) < 1e-6);
}

TEST_CASE("hallucinated ZH3 adds a quarter of L0 (0.08 r + 0.6 r^2), of radiance over pi") {
  const Points points = rings(-1, 8);
  for (const double ambient : {0.0, 0.3, 2.0}) {
    std::vector<glm::dvec3> coefficients = first(light(kLight, kColour), 4);
    coefficients[0] += kColour * (ambient / kY0);
    const std::vector<glm::dvec3> e = irradiance("zh3_hallucinated", coefficients, points.directions).rgb;
    const std::vector<glm::dvec3> linear = irradiance("sh2", coefficients, points.directions).rgb;
    const double l0 = kY0 + ambient / kY0 / kPi, l1 = kY1, ratio = l1 / l0;  // radiance, for colour 1
    const double l2 = l0 * (0.08 * ratio + 0.6 * ratio * ratio);
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double cosine = glm::dot(points.directions[i], kLight);
      const double zonal = std::sqrt(5 / (16 * kPi)) * (3 * cosine * cosine - 1);
      CHECK(largest(e[i] - linear[i] - kColour * (kPi * 0.25 * l2 * zonal)) < 1e-6);
    }
  }
}

TEST_CASE("AHD is ambient light and a clamped cosine, whatever the length of the direction") {
  const glm::dvec3 ambient(0.1, 0.2, 0.3);
  const Points points = rings(-1, 8);
  for (const double length : {1.0, 1e-3, 40.0}) {
    const std::vector<glm::dvec3> e = irradiance("ahd", {ambient, kColour, kLight * length}, points.directions).rgb;
    for (std::size_t i = 0; i < e.size(); ++i)
      CHECK(largest(e[i] - ambient - kColour * std::max(0.0, glm::dot(points.directions[i], kLight))) < 1e-6);
  }
}

TEST_CASE("light without a direction: constant, not NaN, by every basis that divides by one") {
  const Points points = rings(-1, 6);
  const glm::dvec3 zero(0), sky(0.7, 0.9, 1.2);
  // Luminance of l = 1 cancels between red and green, with the shader's own rounding
  const glm::dvec3 balanced(0.7152, -0.2126, 0);
  struct Case {
    const char* basis;
    std::vector<glm::dvec3> coefficients;
  };
  const Case constant[] = {{"zh3", {sky / kY0, zero, zero, zero, sky}},
                           {"zh3_hallucinated", {sky / kY0, zero, zero, zero}},
                           {"l1_nonlinear", {sky / kY0, zero, zero, zero}},
                           {"ahd", {sky, sky, zero}},
                           {"zh3", {sky / kY0, glm::dvec3(1e-30), -glm::dvec3(1e-30), zero, sky}},
                           {"zh3_hallucinated", {sky / kY0, glm::dvec3(1e-30), zero, zero}},
                           {"l1_nonlinear", {sky / kY0, glm::dvec3(1e-30), zero, zero}},
                           {"ahd", {sky, sky, glm::dvec3(0, 1e-30, 0)}}};
  for (const Number number : {Number::scalar, Number::float64})
    for (const Case& c : constant)
      for (const glm::dvec3& e : irradiance(c.basis, c.coefficients, points.directions, number).rgb) {
        CAPTURE(c.basis);
        CHECK(largest(e - sky) < 1e-6);
      }
  const Case finite[] = {{"zh3", {zero, zero, zero, zero, zero}},
                         {"zh3_hallucinated", {zero, zero, zero, zero}},
                         {"l1_nonlinear", {zero, zero, zero, zero}},
                         {"ahd", {zero, zero, zero}},
                         {"zh3", {sky, balanced, balanced, -balanced, sky}},
                         {"zh3_hallucinated", {sky, balanced, balanced, -balanced}},
                         {"zh3_hallucinated", {zero, sky, sky, -sky}},  // direction, but no light
                         {"zh3_hallucinated", {-sky, sky, sky, -sky}},
                         {"zh3_hallucinated", {1e-30 * sky, sky, sky, sky}},
                         {"l1_nonlinear", {zero, sky, sky, -sky}},
                         {"l1_nonlinear", {-sky, sky, sky, -sky}},
                         {"l1_nonlinear", {1e-30 * sky, sky, sky, sky}},
                         {"l1_nonlinear", {sky, 3.0 * sky, sky, sky}}};  // |R1| > R0
  for (const Number number : {Number::scalar, Number::float64})
    for (const Case& c : finite)
      for (const glm::dvec3& e : irradiance(c.basis, c.coefficients, points.directions, number).rgb) {
        CAPTURE(c.basis);
        CHECK(largest(e) < 10);
        CHECK(std::isfinite(e.x + e.y + e.z));
      }
}

TEST_CASE("spherical Gaussians: one at its axis, sharpness 2.133, axes far apart") {
  struct Set {
    const char* basis;
    double smallest_angle_cosine;
  };
  for (const Set& set : {Set{"sg6", 0}, Set{"sg9", 1.0 / 3}, Set{"sg12", 1 / std::sqrt(5.0)}}) {
    CAPTURE(set.basis);
    const Points points = rings(-1, 24);
    const std::vector<double> all = values(set.basis, points.directions);
    const std::size_t count = all.size() / points.directions.size();
    // Axes: log of the lobe is linear in n
    std::vector<glm::dvec3> axes(count, glm::dvec3(0));
    for (std::size_t r = 0; r < points.directions.size(); ++r)
      for (std::size_t i = 0; i < count; ++i)
        axes[i] +=
            points.directions[r] * (points.weights[r] * (std::log(all[r * count + i]) / 2.133 + 1) * 3 / (4 * kPi));
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(glm::length(axes[i]) == doctest::Approx(1).epsilon(1e-6));
      double nearest = -1;
      for (std::size_t j = 0; j < count; ++j)
        if (j != i) nearest = std::max(nearest, glm::dot(axes[i], axes[j]));
      CHECK(nearest < set.smallest_angle_cosine + 1e-6);
      CHECK(values(set.basis, {axes[i]})[i] == doctest::Approx(1).epsilon(1e-6));
    }
  }
}

}  // namespace twinshade::test
