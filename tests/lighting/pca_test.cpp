#include "lighting/pca.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

constexpr std::size_t kStride = 12, kDimension = 10, kCells = 9000;

struct Field {
  std::vector<float> values, weights;
};

// Correlated numbers about a mean that is not zero; every tenth cell does not count.
Field random_field() {
  Field field;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    double source[3];
    for (std::size_t s = 0; s < 3; ++s) source[s] = unit_real(random_bits(7, s, cell)) - 0.5;
    for (std::size_t k = 0; k < kStride; ++k) {
      const double noise = unit_real(random_bits(7, 10 + k, cell));
      field.values.push_back(float(0.3 * double(k) + source[k % 3] * (1 + double(k)) + 0.2 * noise));
    }
    field.weights.push_back(cell % 10 == 0 ? 0.0f : float(0.5 + unit_real(random_bits(7, 99, cell))));
  }
  return field;
}

// Weighted mean over cells of the squared distance between a value and its reconstruction.
double reconstruction_error(const Field& field, const PrincipalComponents& components, std::size_t count) {
  const std::vector<float> weights = components.project(field.values, kStride, count);
  double sum = 0, whole = 0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    double square = 0;
    for (std::size_t k = 0; k < kDimension; ++k) {
      double value = components.mean[k];
      for (std::size_t m = 0; m < count; ++m)
        value += double(weights[cell * count + m]) * components.vectors[m * kDimension + k];
      square += (value - field.values[cell * kStride + k]) * (value - field.values[cell * kStride + k]);
    }
    sum += field.weights[cell] * square;
    whole += field.weights[cell];
  }
  return sum / whole;
}

}  // namespace

TEST_CASE("the mean squared error of M components is the tail of the eigenvalues, and falls with M") {
  const Field field = random_field();
  const PrincipalComponents components =
      principal_components(field.values, kStride, kDimension, field.weights, kDimension);
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t count = 0; count <= kDimension; ++count) {
    INFO("M = " << count);
    const double error = reconstruction_error(field, components, count);
    CHECK(std::fabs(error - components.tail(count)) < 1e-5 * components.tail(count) + 1e-12);
    CHECK(error < before);
    before = error;
  }
  CHECK(components.tail(kDimension) == 0);
}

TEST_CASE("all components together give the values back") {
  const Field field = random_field();
  const PrincipalComponents components =
      principal_components(field.values, kStride, kDimension, field.weights, kDimension);
  CHECK(reconstruction_error(field, components, kDimension) < 1e-11);
}

TEST_CASE("components are orthonormal, ordered, and of fixed sign") {
  const Field field = random_field();
  const PrincipalComponents components =
      principal_components(field.values, kStride, kDimension, field.weights, kDimension);
  for (std::size_t a = 0; a < kDimension; ++a) {
    if (a > 0) CHECK(components.eigenvalues[a] <= components.eigenvalues[a - 1]);
    double largest = 0;
    for (std::size_t k = 0; k < kDimension; ++k)
      if (std::fabs(components.vectors[a * kDimension + k]) > std::fabs(largest))
        largest = components.vectors[a * kDimension + k];
    CHECK(largest > 0);
    for (std::size_t b = 0; b < kDimension; ++b) {
      double dot = 0;
      for (std::size_t k = 0; k < kDimension; ++k)
        dot += components.vectors[a * kDimension + k] * components.vectors[b * kDimension + k];
      CHECK(dot == doctest::Approx(a == b ? 1 : 0).epsilon(1e-12).scale(1));
    }
  }
}

TEST_CASE("fewer components are the first of more, to the bit, on any number of threads") {
  const Field field = random_field();
  set_thread_count(1);
  const PrincipalComponents few = principal_components(field.values, kStride, kDimension, field.weights, 4);
  set_thread_count(4);
  const PrincipalComponents all = principal_components(field.values, kStride, kDimension, field.weights, 10);
  set_thread_count(0);
  CHECK(few.mean == all.mean);
  CHECK(few.eigenvalues == all.eigenvalues);
  CHECK(std::equal(few.vectors.begin(), few.vectors.end(), all.vectors.begin()));
}

TEST_CASE("values that are all the same have that mean, no variance and weights of zero") {
  std::vector<float> values, weights(100, 0.7f);
  for (int cell = 0; cell < 100; ++cell)
    for (int k = 0; k < 4; ++k) values.push_back(0.1f + 0.7f * float(k));
  const PrincipalComponents components = principal_components(values, 4, 4, weights, 4);
  for (std::size_t k = 0; k < 4; ++k) CHECK(components.mean[k] == doctest::Approx(values[k]));
  for (const double eigenvalue : components.eigenvalues) CHECK(eigenvalue == 0);
  for (const float weight : components.project(values, 4, 4)) CHECK(weight == 0);
}

TEST_CASE("components beyond the rank or the dimension are zero") {
  std::vector<float> values, weights(50, 1.0f);
  for (int cell = 0; cell < 50; ++cell)
    for (int k = 0; k < 3; ++k) values.push_back(float(cell) * (k == 1 ? -1.0f : 0.5f));
  const PrincipalComponents components = principal_components(values, 3, 3, weights, 8);
  CHECK(components.count() == 8);
  CHECK(components.eigenvalues[0] > 0);
  CHECK(components.eigenvalues[1] == 0);
  for (std::size_t i = 3; i < components.vectors.size(); ++i) CHECK(components.vectors[i] == 0);
}

TEST_CASE("no cell that counts gives zeros; a value that is not finite is refused") {
  const std::vector<float> values = {1, 2, 3, 4};
  for (const double mean : principal_components(values, 2, 2, std::vector<float>{0, 0}, 2).mean) CHECK(mean == 0);
  const std::vector<float> broken = {1, NAN, 3, 4};
  CHECK_THROWS_AS(principal_components(broken, 2, 2, std::vector<float>{1, 1}, 2), UserError);
}

TEST_CASE(
    "with a metric, the mean of the squared distance is the tail of the eigenvalues, and no other vectors leave less") {
  const Field field = random_field();
  // Positive definite: a diagonal of 1 and more, and a rank-one part
  std::vector<double> metric(kDimension * kDimension);
  for (std::size_t i = 0; i < kDimension; ++i)
    for (std::size_t k = 0; k < kDimension; ++k)
      metric[i * kDimension + k] = (i == k ? 1.0 + double(i % 3) : 0.0) + 0.25 * double(i) * double(k);
  const auto error_of = [&](const PrincipalComponents& components, std::size_t count) {
    const std::vector<float> weights = components.project(field.values, kStride, count);
    double sum = 0, whole = 0;
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      double difference[kDimension];
      for (std::size_t k = 0; k < kDimension; ++k) {
        difference[k] = components.mean[k] - field.values[cell * kStride + k];
        for (std::size_t m = 0; m < count; ++m)
          difference[k] += double(weights[cell * count + m]) * components.vectors[m * kDimension + k];
      }
      for (std::size_t i = 0; i < kDimension; ++i)
        for (std::size_t k = 0; k < kDimension; ++k)
          sum += field.weights[cell] * difference[i] * metric[i * kDimension + k] * difference[k];
      whole += field.weights[cell];
    }
    return sum / whole;
  };
  const PrincipalComponents plain = principal_components(field.values, kStride, kDimension, field.weights, kDimension);
  const PrincipalComponents metered =
      principal_components(field.values, kStride, kDimension, field.weights, kDimension, metric);
  for (std::size_t count = 0; count <= kDimension; ++count) {
    INFO("M = " << count);
    CHECK(std::fabs(error_of(metered, count) - metered.tail(count)) < 1e-5 * metered.tail(count) + 1e-10);
    CHECK(error_of(metered, count) <= error_of(plain, count) * (1 + 1e-5) + 1e-10);
  }
  CHECK(error_of(metered, 2) < 0.9 * error_of(plain, 2));
}

}  // namespace twinshade
