#include "lighting/surface_metric.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

double quadratic(const double* metric, const std::vector<double>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t k = 0; k < v.size(); ++k) sum += v[i] * metric[i * v.size() + k] * v[k];
  return sum;
}

// Whether elimination meets positive pivots alone.
bool is_positive_definite(std::vector<double> m, std::size_t n) {
  for (std::size_t pivot = 0; pivot < n; ++pivot) {
    if (!(m[pivot * n + pivot] > 0)) return false;
    for (std::size_t i = pivot + 1; i < n; ++i)
      for (std::size_t k = pivot + 1; k < n; ++k)
        m[i * n + k] -= m[i * n + pivot] * m[pivot * n + k] / m[pivot * n + pivot];
  }
  return true;
}

// A unit normal for each cell, in all directions.
std::vector<float> random_normals(std::size_t cells) {
  std::vector<float> normals;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double z = 2 * unit_real(random_bits(5, 0, cell)) - 1;
    const double phi = 2 * std::numbers::pi * unit_real(random_bits(5, 1, cell)), r = std::sqrt(1 - z * z);
    for (const double value : {r * std::cos(phi), r * std::sin(phi), z}) normals.push_back(float(value));
  }
  return normals;
}

// What is seen of a direction: a smooth lobe, as SH.
std::vector<double> lobe_towards(const glm::dvec3& direction, int order) {
  const std::vector<double> basis = radiance_basis(std::vector<glm::dvec3>{direction}, kMostRadianceCount);
  std::vector<double> lobe(basis.begin(), basis.begin() + order * order);
  for (int l = 0; l < order; ++l)
    for (int j = l * l; j < (l + 1) * (l + 1); ++j) lobe[std::size_t(j)] *= std::exp(-0.1 * l * (l + 1));
  return lobe;
}

}  // namespace

TEST_CASE("where all is visible the metric is the mean square irradiance of unit lights, wherever a surface faces") {
  const std::vector<float> normals = random_normals(5000), weights(5000, 1.0f);
  // A_l: pi, 2 pi / 3, pi / 4, 0, -pi / 24, 0; coefficients 2 l + 1 of 1 / (4 pi) each; the visibility is Y_0 squared
  constexpr double kPi = std::numbers::pi;
  const double factors[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0};
  for (int order = 2; order <= 6; ++order) {
    double expected = 0;
    for (int l = 0; l < order; ++l) expected += factors[l] * factors[l] * (2 * l + 1) / (4 * kPi) / (4 * kPi);
    const std::size_t n = std::size_t(order) * std::size_t(order);
    const std::vector<double> metrics = surface_metrics(normals, weights, order);
    REQUIRE(metrics.size() == kSurfaceGroups * n * n);
    std::vector<double> all(n, 0.0);
    all[0] = 1;
    for (std::size_t group = 0; group < kSurfaceGroups; ++group) {
      const double value = quadratic(metrics.data() + group * n * n, all);
      CAPTURE(order);
      CAPTURE(group);
      CHECK(value > expected * (1 - 1e-6));
      CHECK(value < expected * 1.03);
    }
  }
}

TEST_CASE("metrics of surfaces are symmetric and positive definite, and see what is above, not what is below") {
  constexpr int kOrder = 6;
  constexpr std::size_t kCount = kOrder * kOrder;
  const std::vector<float> normals = random_normals(5000), weights(5000, 1.0f);
  const std::vector<std::uint16_t> groups = surface_groups(normals);
  const std::vector<double> metrics = surface_metrics(normals, weights, kOrder);
  for (std::size_t cell = 0; cell < 200; ++cell) {
    const double* metric = metrics.data() + std::size_t(groups[cell]) * kCount * kCount;
    CAPTURE(cell);
    double asymmetry = 0;
    for (std::size_t i = 0; i < kCount; ++i)
      for (std::size_t k = 0; k < i; ++k)
        asymmetry = std::max(asymmetry, std::fabs(metric[i * kCount + k] - metric[k * kCount + i]));
    CHECK(asymmetry < 1e-12);
    CHECK(is_positive_definite({metric, metric + kCount * kCount}, kCount));
    const glm::dvec3 normal(normals[cell * 3], normals[cell * 3 + 1], normals[cell * 3 + 2]);
    CHECK(quadratic(metric, lobe_towards(normal, kOrder)) > 5 * quadratic(metric, lobe_towards(-normal, kOrder)));
  }
}

TEST_CASE(
    "surfaces that face alike are of one group, whatever their length; those without a normal are of some group") {
  const float up[] = {0, 0, 1, 0, 0, 0.25f, 0.05f, 0.02f, 1, 0, 0, -1, 1, 0, 0, 0, 0, 0};
  const std::vector<std::uint16_t> groups = surface_groups(up);
  REQUIRE(groups.size() == 6);
  CHECK(groups[0] == groups[1]);
  CHECK(groups[0] == groups[2]);
  CHECK(groups[0] != groups[3]);
  CHECK(groups[0] != groups[4]);
  CHECK(groups[3] != groups[4]);
  for (const std::uint16_t group : groups) CHECK(group < kSurfaceGroups);
}

TEST_CASE("a normal along an axis and the same but for rounding are of one group") {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f})
      for (const float off : {-1e-6f, 1e-6f}) {
        float normals[6] = {};
        normals[axis] = normals[3 + axis] = sign;
        normals[3 + (axis + 1) % 3] = off;
        normals[3 + (axis + 2) % 3] = -off;
        const std::vector<std::uint16_t> groups = surface_groups(normals);
        CHECK(groups[0] == groups[1]);
      }
}

TEST_CASE("metrics of surfaces do not depend on the number of threads") {
  const std::vector<float> normals = random_normals(1000), weights(1000, 0.5f);
  const int threads = thread_count();
  set_thread_count(1);
  const std::vector<double> one = surface_metrics(normals, weights, 4);
  set_thread_count(7);
  CHECK(surface_metrics(normals, weights, 4) == one);
  set_thread_count(threads);
}

}  // namespace twinshade
