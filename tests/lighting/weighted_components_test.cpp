#include "lighting/weighted_components.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

constexpr std::size_t kStride = 12, kDimension = 10, kCells = 6000, kGroups = 5;

struct Field {
  std::vector<float> values, weights;
  std::vector<std::uint16_t> groups;
  std::vector<double> metrics;

  GroupMetrics group_metrics() const { return {groups, metrics}; }
  WeightedComponents fit(std::size_t count) const {
    return weighted_components(values, kStride, weights, group_metrics(), start(count));
  }
  PrincipalComponents start(std::size_t count) const {
    return principal_components(values, kStride, kDimension, weights, count,
                                mean_metric(group_metrics(), weights, kDimension));
  }
};

double random_real(std::uint64_t stream, std::uint64_t i) { return 2 * unit_real(random_bits(3, stream, i)) - 1; }

// Full rank, every tenth cell does not count. matters(group, k): how much dimension k does there.
template <class Matters>
Field random_field(const Matters& matters) {
  Field field;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    for (std::size_t k = 0; k < kStride; ++k)
      field.values.push_back(float(0.3 * double(k) + random_real(k, cell) + random_real(k % 3 + 50, cell)));
    field.weights.push_back(cell % 10 == 0 ? 0.0f : float(1.5 + random_real(99, cell)));
    field.groups.push_back(std::uint16_t(cell * 7 % kGroups));
  }
  field.metrics.assign(kGroups * kDimension * kDimension, 0.0);
  for (std::size_t g = 0; g < kGroups; ++g)
    for (std::size_t k = 0; k < kDimension; ++k) field.metrics[(g * kDimension + k) * kDimension + k] = matters(g, k);
  return field;
}

double alike(std::size_t, std::size_t) { return 1; }
// Each group has four dimensions of its own that hardly matter.
double by_group(std::size_t group, std::size_t k) { return (k + 2 * group) % kDimension < 4 ? 0.001 : 1; }

// Weighted mean over cells of the square of the distance, in its metric, between a value and what weights make of it.
double measured_error(const Field& field, const std::vector<double>& mean, const std::vector<double>& vectors,
                      const std::vector<float>& weights) {
  const std::size_t count = vectors.size() / kDimension;
  double sum = 0, whole = 0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    double error[kDimension];
    for (std::size_t k = 0; k < kDimension; ++k) {
      error[k] = mean[k] - field.values[cell * kStride + k];
      for (std::size_t m = 0; m < count; ++m)
        error[k] += double(weights[cell * count + m]) * vectors[m * kDimension + k];
    }
    const double* metric = field.metrics.data() + field.groups[cell] * kDimension * kDimension;
    for (std::size_t i = 0; i < kDimension; ++i)
      for (std::size_t k = 0; k < kDimension; ++k)
        sum += field.weights[cell] * error[i] * metric[i * kDimension + k] * error[k];
    whole += field.weights[cell];
  }
  return sum / whole;
}

double measured_error(const Field& field, const WeightedComponents& fit) {
  return measured_error(field, fit.mean, fit.vectors, fit.project(field.values, kStride, field.groups));
}

}  // namespace

TEST_CASE("where all cells weigh alike, weighted components are the principal components") {
  const Field field = random_field(alike);
  for (const std::size_t count : {1, 3, 6}) {
    const PrincipalComponents principal = field.start(count);
    const WeightedComponents weighted = field.fit(count);
    CAPTURE(count);
    CHECK(weighted.error == doctest::Approx(principal.tail(count)).epsilon(1e-9));
    CHECK(weighted.mean == principal.mean);
    for (std::size_t i = 0; i < count * kDimension; ++i)
      CHECK(weighted.vectors[i] == doctest::Approx(principal.vectors[i]).epsilon(1e-6));
  }
}

TEST_CASE("the error of weighted components is what is measured, below that of principal components, and falls") {
  const Field field = random_field(by_group);
  double before = 1e30;
  for (std::size_t count = 1; count < kDimension; ++count) {
    const PrincipalComponents principal = field.start(count);
    const WeightedComponents weighted = field.fit(count);
    CAPTURE(count);
    CHECK(weighted.error == doctest::Approx(measured_error(field, weighted)).epsilon(1e-5));
    CHECK(weighted.error < before);
    CHECK(weighted.error <= 1.000001 * measured_error(field, principal.mean, principal.vectors,
                                                      principal.project(field.values, kStride, count)));
    before = weighted.error;
  }
  // Six dimensions matter in each group. Best weights for the principal components would leave 6% of their error.
  const PrincipalComponents principal = field.start(6);
  CHECK(field.fit(6).error <
        0.02 * measured_error(field, principal.mean, principal.vectors, principal.project(field.values, kStride, 6)));
}

TEST_CASE("what is of low rank where it matters is found under whatever else there is") {
  constexpr double kHardly = 1e-7;
  Field field =
      random_field([&](std::size_t group, std::size_t k) { return (k + 2 * group) % kDimension < 2 ? kHardly : 1; });
  for (std::size_t cell = 0; cell < kCells; ++cell)
    for (std::size_t k = 0; k < kDimension; ++k) {
      double value = 0;
      for (std::size_t m = 0; m < 3; ++m) value += random_real(10 + m, k) * random_real(20 + m, cell);
      if ((k + 2 * field.groups[cell]) % kDimension < 2) value += 3 * random_real(30 + k, cell);
      field.values[cell * kStride + k] = float(value);
    }
  // Principal components in the mean metric follow the noise
  CHECK(field.start(3).tail(3) > 0.1);
  CHECK(field.fit(3).error < 0.01);
}

TEST_CASE("weights of weighted components are uncorrelated, most variance first, and signs are defined") {
  const Field field = random_field(by_group);
  const WeightedComponents fit = field.fit(4);
  const std::vector<float> weights = fit.project(field.values, kStride, field.groups);
  double products[4][4] = {};
  for (std::size_t cell = 0; cell < kCells; ++cell)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        products[a][b] += field.weights[cell] * double(weights[cell * 4 + a]) * double(weights[cell * 4 + b]);
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) CHECK(std::fabs(products[a][b]) < 1e-4 * products[0][0]);
    if (a > 0) CHECK(products[a][a] < products[a - 1][a - 1]);
    const double* vector = fit.vectors.data() + a * kDimension;
    CHECK(*std::max_element(vector, vector + kDimension,
                            [](double x, double y) { return std::fabs(x) < std::fabs(y); }) > 0);
  }
}

TEST_CASE("vectors of weighted components are orthonormal in the mean metric") {
  const Field field = random_field(by_group);
  const std::vector<double> metric = mean_metric(field.group_metrics(), field.weights, kDimension);
  const WeightedComponents fit = field.fit(5);
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = 0; b < 5; ++b) {
      double product = 0;
      for (std::size_t i = 0; i < kDimension; ++i)
        for (std::size_t k = 0; k < kDimension; ++k)
          product += fit.vectors[a * kDimension + i] * metric[i * kDimension + k] * fit.vectors[b * kDimension + k];
      CHECK(product == doctest::Approx(a == b ? 1.0 : 0.0).epsilon(1e-9));
    }
}

TEST_CASE("weighted components do not depend on the number of threads") {
  const Field field = random_field(by_group);
  const int threads = thread_count();
  set_thread_count(1);
  const WeightedComponents one = field.fit(4);
  set_thread_count(7);
  const WeightedComponents seven = field.fit(4);
  set_thread_count(threads);
  CHECK(seven.vectors == one.vectors);
  CHECK(seven.duals == one.duals);
  CHECK(seven.error == one.error);
}

}  // namespace twinshade
