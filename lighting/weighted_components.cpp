#include "lighting/weighted_components.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"

namespace twinshade {
namespace {

using Matrix = Eigen::MatrixXd;

// Stops where a round takes less than this part of the error, or after so many.
constexpr double kLeastProgress = 0.002;
constexpr int kMostRounds = 100;

// Cells of one metric; empty where none counts.
struct Group {
  Matrix metric;   // n x n
  Matrix moments;  // n x n: weighted sum of (value - mean) (value - mean)', the weights of all cells adding up to 1
  double weight = 0;
  Matrix duals;  // M x n
};

std::vector<Group> gather_groups(std::span<const float> values, std::size_t stride, std::span<const float> cell_weights,
                                 const GroupMetrics& metrics, const std::vector<double>& mean) {
  const std::size_t n = mean.size();
  TWINSHADE_CHECK_EQ(metrics.metrics.size() % (n * n), std::size_t{0});
  const auto size = Eigen::Index(n);
  std::vector<std::vector<std::uint32_t>> cells(metrics.metrics.size() / (n * n));
  double whole = 0;
  for (std::size_t cell = 0; cell < cell_weights.size(); ++cell)
    if (cell_weights[cell] > 0) {
      TWINSHADE_CHECK_LT(std::size_t(metrics.group_of_cell[cell]), cells.size());
      cells[metrics.group_of_cell[cell]].push_back(std::uint32_t(cell));
      whole += cell_weights[cell];
    }
  std::vector<Group> groups(cells.size());
  parallel_for(groups.size(), [&](std::size_t g, int) {
    Group& group = groups[g];
    group.metric = Eigen::Map<const Matrix>(metrics.metrics.data() + g * n * n, size, size);
    group.moments = Matrix::Zero(size, size);
    Eigen::VectorXd value(size);
    for (const std::uint32_t cell : cells[g]) {
      const double weight = cell_weights[cell] / whole;
      for (std::size_t k = 0; k < n; ++k) value(Eigen::Index(k)) = values[cell * stride + k] - mean[k];
      group.moments.selfadjointView<Eigen::Lower>().rankUpdate(value, weight);
      group.weight += weight;
    }
    group.moments = Matrix(group.moments.selfadjointView<Eigen::Lower>());
  });
  return groups;
}

// What one round needs of each group once its cells have their best weights.
struct Round {
  Matrix covariance;  // M x M: of the weights
  Matrix target;      // n x M: metric times moments of values and weights
  double error = 0;
};

void set_duals(const Matrix& vectors, Group& group) {
  const Matrix through = vectors.transpose() * group.metric;
  group.duals = (through * vectors).ldlt().solve(through);
}

// Best weights for these vectors, where any cell counts. Returns the error.
double choose_weights(std::vector<Group>& groups, const Matrix& vectors, std::vector<Round>& rounds) {
  parallel_for(groups.size(), [&](std::size_t g, int) {
    Group& group = groups[g];
    if (!(group.weight > 0)) return;
    set_duals(vectors, group);
    Round& round = rounds[g];
    const Matrix cross = group.moments * group.duals.transpose();  // n x M
    round.covariance = group.duals * cross;
    round.target = group.metric * cross;
    // The best weights leave what is orthogonal to all vectors, in the metric
    round.error = (group.metric * group.moments).trace() - (vectors.transpose() * round.target).trace();
  });
  double error = 0;
  for (const Round& round : rounds) error += round.error;
  return error;
}

// Best vectors for these weights, each in turn with the others held.
void choose_vectors(const std::vector<Group>& groups, const std::vector<Round>& rounds, Matrix& vectors) {
  const Eigen::Index n = vectors.rows();
  for (Eigen::Index m = 0; m < vectors.cols(); ++m) {
    Matrix matrix = Matrix::Zero(n, n);
    Eigen::VectorXd target = Eigen::VectorXd::Zero(n);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!(groups[g].weight > 0)) continue;
      const Matrix& covariance = rounds[g].covariance;
      const Eigen::VectorXd others = vectors * covariance.col(m) - vectors.col(m) * covariance(m, m);
      matrix += covariance(m, m) * groups[g].metric;
      target += rounds[g].target.col(m) - groups[g].metric * others;
    }
    if (!(matrix.trace() > 0)) continue;  // no cell has any weight of it
    vectors.col(m) = matrix.ldlt().solve(target);
  }
}

// The same span, orthonormal in the mean metric and with uncorrelated weights, most variance first.
void turn_to_principal_axes(const std::vector<Group>& groups, const std::vector<Round>& rounds, Matrix& vectors) {
  const Eigen::Index n = vectors.rows(), count = vectors.cols();
  Matrix metric = Matrix::Zero(n, n), covariance = Matrix::Zero(count, count);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!(groups[g].weight > 0)) continue;
    metric += groups[g].weight * groups[g].metric;
    covariance += rounds[g].covariance;
  }
  const Eigen::LLT<Matrix> root(vectors.transpose() * metric * vectors);
  TWINSHADE_CHECK_EQ(int(root.info()), int(Eigen::Success));
  const Matrix lower = root.matrixL();
  const Matrix orthonormal = lower.triangularView<Eigen::Lower>().solve(vectors.transpose()).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(lower.transpose() * covariance * lower);  // ascending
  vectors = orthonormal * solver.eigenvectors().rowwise().reverse();
  for (Eigen::Index m = 0; m < count; ++m) {
    Eigen::Index largest = 0;
    for (Eigen::Index k = 1; k < n; ++k)
      if (std::abs(vectors(k, m)) > std::abs(vectors(largest, m))) largest = k;
    if (vectors(largest, m) < 0) vectors.col(m) *= -1;
  }
}

}  // namespace

std::vector<double> mean_metric(const GroupMetrics& metrics, std::span<const float> cell_weights,
                                std::size_t dimension) {
  TWINSHADE_CHECK_EQ(metrics.group_of_cell.size(), cell_weights.size());
  const std::size_t square = dimension * dimension;
  std::vector<double> weights(metrics.metrics.size() / square, 0.0), mean(square, 0.0);
  double whole = 0;
  for (std::size_t cell = 0; cell < cell_weights.size(); ++cell) {
    weights[metrics.group_of_cell[cell]] += cell_weights[cell];
    whole += cell_weights[cell];
  }
  for (std::size_t g = 0; g < weights.size(); ++g)
    for (std::size_t i = 0; i < square; ++i)
      mean[i] += (whole > 0 ? weights[g] / whole : 1.0 / double(weights.size())) * metrics.metrics[g * square + i];
  return mean;
}

WeightedComponents weighted_components(std::span<const float> values, std::size_t stride,
                                       std::span<const float> cell_weights, const GroupMetrics& metrics,
                                       const PrincipalComponents& start) {
  TWINSHADE_CHECK_EQ(values.size(), stride * cell_weights.size());
  TWINSHADE_CHECK_EQ(metrics.group_of_cell.size(), cell_weights.size());
  TWINSHADE_CHECK_LT(0.0, start.tail(start.count()));
  const auto n = Eigen::Index(start.dimension), count = Eigen::Index(start.count());
  std::vector<Group> groups = gather_groups(values, stride, cell_weights, metrics, start.mean);
  std::vector<Round> rounds(groups.size());
  Matrix vectors = Eigen::Map<const Matrix>(start.vectors.data(), n, count);

  double error = choose_weights(groups, vectors, rounds);
  for (int round = 0; round < kMostRounds; ++round) {
    choose_vectors(groups, rounds, vectors);
    const double before = error;
    error = choose_weights(groups, vectors, rounds);
    if (!(error < (1 - kLeastProgress) * before)) break;
  }
  turn_to_principal_axes(groups, rounds, vectors);

  WeightedComponents out;
  out.dimension = start.dimension, out.components = start.count(), out.mean = start.mean;
  out.error = std::max(0.0, choose_weights(groups, vectors, rounds));
  out.vectors.assign(vectors.data(), vectors.data() + vectors.size());
  for (Group& group : groups) {
    if (!(group.weight > 0)) set_duals(vectors, group);  // cells that do not count have weights, too
    const Matrix by_row = group.duals.transpose();
    out.duals.insert(out.duals.end(), by_row.data(), by_row.data() + by_row.size());
  }
  return out;
}

std::vector<float> WeightedComponents::project(std::span<const float> values, std::size_t stride,
                                               std::span<const std::uint16_t> group_of_cell) const {
  TWINSHADE_CHECK_EQ(values.size(), stride * group_of_cell.size());
  const auto duals_of = [&](std::size_t cell) { return duals.data() + group_of_cell[cell] * components * dimension; };
  return project_onto(mean, components, duals_of, values, stride);
}

}  // namespace twinshade
