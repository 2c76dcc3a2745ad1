#include "lighting/visibility_components.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "lighting/random.h"
#include "lighting/surface_metric.h"

namespace twinshade {
namespace {

constexpr PcaMetric kMetrics[] = {PcaMetric::surface, PcaMetric::visibility, PcaMetric::irradiance};

// A bake of cells that face all ways and see what they like.
VisibilityBake random_bake(std::uint32_t cells) {
  VisibilityBake bake;
  bake.width = cells, bake.height = 1;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    for (std::uint64_t k = 0; k < kVisibilityCount; ++k)
      bake.sh.push_back(float(unit_real(random_bits(11, k, cell)) - 0.5) / float(1 + k));
    const double z = 2 * unit_real(random_bits(11, 40, cell)) - 1, r = std::sqrt(1 - z * z);
    const double phi = 2 * std::numbers::pi * unit_real(random_bits(11, 41, cell));
    for (const double value : {r * std::cos(phi), r * std::sin(phi), z}) bake.normal.push_back(float(value));
    bake.area.push_back(1);
    bake.ambient.push_back(0.5f);
  }
  return bake;
}

std::vector<double> random_light() {
  std::vector<double> light(36 * 3);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = (i < 3 ? 2 : 0) + unit_real(random_bits(12, 0, i)) - 0.5;
  return light;
}

// The largest difference between visibility and what rows and weights make of it.
double largest_error(const VisibilityBake& bake, VisibilityComponents& components, std::size_t count, std::size_t n) {
  const std::vector<double> rows = components.rows(count);
  const std::vector<float> weights = components.weights(bake, count);
  REQUIRE(rows.size() == (count + 1) * n);
  REQUIRE(weights.size() == bake.cells() * count);
  double largest = 0;
  for (std::size_t cell = 0; cell < bake.cells(); ++cell)
    for (std::size_t k = 0; k < n; ++k) {
      double value = rows[k];
      for (std::size_t m = 0; m < count; ++m) value += double(weights[cell * count + m]) * rows[(m + 1) * n + k];
      largest = std::max(largest, std::fabs(value - double(bake.sh[cell * kVisibilityCount + k])));
    }
  return largest;
}

}  // namespace

TEST_CASE("as many components as coefficients lose nothing, whatever they are chosen for") {
  const VisibilityBake bake = random_bake(500);
  for (const PcaMetric metric : kMetrics)
    for (const int order : {2, 3}) {
      const auto n = std::size_t(order * order);
      VisibilityComponents components(bake, order, metric, random_light());
      CAPTURE(int(metric));
      CAPTURE(order);
      CHECK(largest_error(bake, components, n, n) < 1e-5);
      CHECK(largest_error(bake, components, n + 3, n) < 1e-5);
      CHECK(largest_error(bake, components, n - 2, n) > 1e-4);
    }
}

TEST_CASE("components chosen by surface err least where surfaces show it, the paper's in all directions") {
  constexpr std::size_t kOrder = 4, kDimension = 16, kCount = 6;
  const VisibilityBake bake = random_bake(2000);
  const std::vector<std::uint16_t> groups = surface_groups(bake.normal);
  const std::vector<double> metrics = surface_metrics(bake.normal, bake.area, kOrder);
  struct Errors {
    double by_surface = 0, all_around = 0;
  };
  const auto errors_of = [&](PcaMetric metric) {
    VisibilityComponents components(bake, kOrder, metric, random_light());
    const std::vector<double> rows = components.rows(kCount);
    const std::vector<float> weights = components.weights(bake, kCount);
    Errors sum;
    for (std::size_t cell = 0; cell < bake.cells(); ++cell) {
      double error[kDimension];
      for (std::size_t k = 0; k < kDimension; ++k) {
        error[k] = rows[k] - double(bake.sh[cell * kVisibilityCount + k]);
        for (std::size_t m = 0; m < kCount; ++m)
          error[k] += double(weights[cell * kCount + m]) * rows[(m + 1) * kDimension + k];
        sum.all_around += error[k] * error[k];
      }
      const double* matrix = metrics.data() + groups[cell] * kDimension * kDimension;
      for (std::size_t i = 0; i < kDimension; ++i)
        for (std::size_t k = 0; k < kDimension; ++k) sum.by_surface += error[i] * matrix[i * kDimension + k] * error[k];
    }
    return sum;
  };
  const Errors surface = errors_of(PcaMetric::surface), all = errors_of(PcaMetric::visibility);
  CHECK(all.all_around < surface.all_around);
  CHECK(surface.by_surface < all.by_surface);
}

TEST_CASE("another bake has weights of the same components, wherever its surfaces face") {
  VisibilityBake some = random_bake(300), others = random_bake(800);
  // None faces up
  for (std::size_t cell = 0; cell < some.cells(); ++cell)
    some.normal[cell * 3 + 2] = -std::fabs(some.normal[cell * 3 + 2]);
  for (const PcaMetric metric : kMetrics) {
    VisibilityComponents components(some, 3, metric, random_light());
    CAPTURE(int(metric));
    const std::vector<float> own = components.weights(some, 4), whole = components.weights(others, 4);
    REQUIRE(whole.size() == others.cells() * 4);
    CHECK(std::all_of(whole.begin(), whole.end(), [](float weight) { return std::fabs(weight) < 100; }));
    // The first cells are the same where they face the same
    for (std::size_t cell = 0; cell < some.cells(); ++cell)
      if (others.normal[cell * 3 + 2] < 0)
        for (std::size_t m = 0; m < 4; ++m) CHECK(whole[cell * 4 + m] == own[cell * 4 + m]);
  }
}

TEST_CASE("without any surface that counts components are zero") {
  VisibilityBake bake = random_bake(50);
  std::fill(bake.area.begin(), bake.area.end(), 0.0f);
  for (const PcaMetric metric : kMetrics) {
    VisibilityComponents components(bake, 3, metric, random_light());
    for (const double value : components.rows(4)) CHECK(value == 0);
    for (const float weight : components.weights(bake, 4)) CHECK(weight == 0);
  }
}

TEST_CASE("metrics of components are found by name") {
  for (const PcaMetric metric : kMetrics) CHECK(find_pca_metric(std::string(pca_metric_name(metric))) == metric);
  CHECK_THROWS_WITH_AS(find_pca_metric("surfaces"), doctest::Contains("surface"), UserError);
}

}  // namespace twinshade
