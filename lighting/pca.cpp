#include "lighting/pca.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace twinshade {
namespace {

constexpr std::size_t kCellsAtOnce = 4096;  // cells
// Variance below this part of the mean square is rounding.
constexpr double kNoVariance = 1e-13;

// Calls body(cell, sums) for all cells and adds the sums of blocks in order, whatever the number of threads.
template <class Body>
std::vector<double> blockwise_sum(std::size_t cells, std::size_t size, const Body& body) {
  const std::size_t blocks = (cells + kCellsAtOnce - 1) / kCellsAtOnce;
  std::vector<std::vector<double>> parts(blocks);
  parallel_for(blocks, [&](std::size_t block, int) {
    parts[block].assign(size, 0.0);
    for (std::size_t cell = block * kCellsAtOnce; cell < std::min(cells, (block + 1) * kCellsAtOnce); ++cell)
      body(cell, parts[block].data());
  });
  std::vector<double> sum(size, 0.0);
  for (const std::vector<double>& part : parts)
    for (std::size_t i = 0; i < size; ++i) sum[i] += part[i];
  return sum;
}

// The symmetric root of a metric, and its inverse; of none: identity.
struct Root {
  Eigen::MatrixXd sqrt, inverse_sqrt;
};
Root root_of(std::span<const double> metric, std::size_t n) {
  const auto size = Eigen::Index(n);
  if (metric.empty()) return {Eigen::MatrixXd::Identity(size, size), Eigen::MatrixXd::Identity(size, size)};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::Map<const Eigen::MatrixXd>(metric.data(), size, size));
  return {solver.operatorSqrt(), solver.operatorInverseSqrt()};
}

}  // namespace

double PrincipalComponents::tail(std::size_t components) const {
  double sum = 0;
  for (std::size_t i = dimension; i > components; --i) sum += eigenvalues[i - 1];
  return sum;
}

PrincipalComponents principal_components(std::span<const float> values, std::size_t stride, std::size_t dimension,
                                         std::span<const float> cell_weights, std::size_t components,
                                         std::span<const double> metric) {
  TWINSHADE_CHECK_EQ(values.size(), stride * cell_weights.size());
  TWINSHADE_CHECK_LE(dimension, stride);
  if (!metric.empty()) TWINSHADE_CHECK_EQ(metric.size(), dimension * dimension);
  const std::size_t cells = cell_weights.size(), n = dimension;
  PrincipalComponents out;
  out.dimension = n;
  out.mean.assign(n, 0.0);
  out.vectors.assign(components * n, 0.0);
  out.duals.assign(components * n, 0.0);
  out.eigenvalues.assign(n, 0.0);

  // Weight, then weighted sum and sum of squares
  const std::vector<double> first = blockwise_sum(cells, 1 + n, [&](std::size_t cell, double* sum) {
    const double weight = cell_weights[cell];
    if (weight == 0) return;
    sum[0] += weight;
    for (std::size_t k = 0; k < n; ++k) sum[1 + k] += weight * values[cell * stride + k];
  });
  for (const double value : first)
    if (!std::isfinite(value)) throw UserError("principal components: a value or a weight is not finite");
  if (!(first[0] > 0)) return out;
  for (std::size_t k = 0; k < n; ++k) out.mean[k] = first[1 + k] / first[0];

  const std::vector<double> second = blockwise_sum(cells, n * n, [&](std::size_t cell, double* sum) {
    const double weight = cell_weights[cell];
    if (weight == 0) return;
    const float* value = values.data() + cell * stride;
    for (std::size_t i = 0; i < n; ++i) {
      const double difference = weight * (value[i] - out.mean[i]);
      for (std::size_t k = 0; k <= i; ++k) sum[i * n + k] += difference * (value[k] - out.mean[k]);
    }
  });
  Eigen::MatrixXd covariance(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k <= i; ++k)
      covariance(Eigen::Index(i), Eigen::Index(k)) = covariance(Eigen::Index(k), Eigen::Index(i)) =
          second[i * n + k] / first[0];
  // Components of the values times the metric's root: there its distance is a sum of squares
  const Root root = root_of(metric, n);
  if (!metric.empty()) covariance = (root.sqrt * covariance * root.sqrt).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);  // ascending
  const double mean_square =
      (root.sqrt * Eigen::Map<const Eigen::VectorXd>(out.mean.data(), Eigen::Index(n))).squaredNorm();
  const double least = kNoVariance * (mean_square + covariance.trace());
  for (std::size_t m = 0; m < n; ++m) {
    const Eigen::Index column = Eigen::Index(n - 1 - m);
    const double eigenvalue = solver.eigenvalues()(column);
    if (!(eigenvalue > least)) break;
    out.eigenvalues[m] = eigenvalue;
    if (m >= components) continue;
    const Eigen::VectorXd eigenvector = solver.eigenvectors().col(column), vector = root.inverse_sqrt * eigenvector,
                          dual = root.sqrt * eigenvector;
    Eigen::Index largest = 0;
    for (Eigen::Index k = 1; k < Eigen::Index(n); ++k)
      if (std::abs(vector(k)) > std::abs(vector(largest))) largest = k;
    for (std::size_t k = 0; k < n; ++k) {
      out.vectors[m * n + k] = vector(largest) < 0 ? -vector(Eigen::Index(k)) : vector(Eigen::Index(k));
      out.duals[m * n + k] = vector(largest) < 0 ? -dual(Eigen::Index(k)) : dual(Eigen::Index(k));
    }
  }
  return out;
}

std::vector<float> PrincipalComponents::project(std::span<const float> values, std::size_t stride,
                                                std::size_t components) const {
  TWINSHADE_CHECK_LE(components, count());
  return project_onto(
      mean, components, [&](std::size_t) { return duals.data(); }, values, stride);
}

std::vector<float> project_onto(std::span<const double> mean, std::size_t components,
                                const std::function<const double*(std::size_t cell)>& duals_of,
                                std::span<const float> values, std::size_t stride) {
  const std::size_t dimension = mean.size(), cells = stride == 0 ? 0 : values.size() / stride;
  std::vector<float> weights(cells * components);
  parallel_for((cells + kCellsAtOnce - 1) / kCellsAtOnce, [&](std::size_t block, int) {
    for (std::size_t cell = block * kCellsAtOnce; cell < std::min(cells, (block + 1) * kCellsAtOnce); ++cell) {
      const double* duals = duals_of(cell);
      for (std::size_t m = 0; m < components; ++m) {
        double sum = 0;
        for (std::size_t k = 0; k < dimension; ++k)
          sum += duals[m * dimension + k] * (values[cell * stride + k] - mean[k]);
        weights[cell * components + m] = float(sum);
      }
    }
  });
  return weights;
}

}  // namespace twinshade
