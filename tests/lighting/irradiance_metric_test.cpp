#include "lighting/irradiance_metric.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "lighting/light_tables.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

std::vector<double> random_numbers(std::size_t count, std::uint64_t seed) {
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = 2 * unit_real(random_bits(seed, 0, i)) - 1;
  return numbers;
}

double quadratic(const std::vector<double>& metric, const std::vector<double>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t k = 0; k < v.size(); ++k) sum += v[i] * metric[i * v.size() + k] * v[k];
  return sum;
}

}  // namespace

TEST_CASE("the metric of irradiance is the integral of its square over normals") {
  constexpr int kRows = 90, kColumns = 180;
  std::vector<glm::dvec3> normals;
  std::vector<double> solid_angles;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double theta = std::numbers::pi * (row + 0.5) / kRows, phi = 2 * std::numbers::pi * column / kColumns;
      normals.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      solid_angles.push_back(std::sin(theta) * std::numbers::pi / kRows * 2 * std::numbers::pi / kColumns);
    }
  const std::vector<double> basis = radiance_basis(normals, kMostRadianceCount);
  const auto cosine = clamped_cosine_factors();
  for (const int order : {2, 4, 6}) {
    CAPTURE(order);
    const std::size_t n = std::size_t(order) * std::size_t(order);
    const std::vector<double> light = random_numbers(n * 3, 3), visibility = random_numbers(n, 4);
    const std::vector<double> product = light_times_vectors(light, visibility, order);  // [channel * n + j]
    double integral = 0;
    for (std::size_t p = 0; p < normals.size(); ++p)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        double irradiance = 0;
        for (std::size_t j = 0; j < n; ++j)
          irradiance += cosine[j] * product[channel * n + j] * basis[p * kMostRadianceCount + j];
        integral += solid_angles[p] * irradiance * irradiance;
      }
    CHECK(quadratic(irradiance_metric(light, order), visibility) == doctest::Approx(integral).epsilon(1e-3));
  }
}

TEST_CASE("without light all visibility matters alike, and no metric is singular") {
  const std::vector<double> dark = irradiance_metric(std::vector<double>(12, 0.0), 2);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) CHECK(dark[i * 4 + k] == (i == k ? 1.0 : 0.0));
  // Constant light shows order 3 of visibility, but not l = 3 and more
  std::vector<double> constant(36 * 3, 0.0);
  constant[0] = constant[1] = constant[2] = 1;
  const std::vector<double> metric = irradiance_metric(constant, 6);
  std::vector<double> shown(36, 0.0), unseen(36, 0.0);
  shown[4] = 1, unseen[9] = 1;  // l = 2, l = 3
  CHECK(quadratic(metric, unseen) > 0);
  CHECK(quadratic(metric, shown) > 1e3 * quadratic(metric, unseen));
}

}  // namespace twinshade
