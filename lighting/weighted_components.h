// Components of a field of vectors where a difference matters more in some cells than in others, and in other ways: low
// rank approximation with a weight of its own for every value, by alternating least squares (Gabriel and Zamir, Lower
// Rank Approximation of Matrices by Least Squares with Any Choice of Weights, Technometrics 1979).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/pca.h"

namespace twinshade {

// value = mean + sum over m of weight_m * vector_m, where the weights of a cell are those of least error in its metric.
struct WeightedComponents {
  std::size_t dimension = 0, components = 0;
  std::vector<double> mean;     // [dimension]
  std::vector<double> vectors;  // [component * dimension + k]
  // weight_m = dual_m . (value - mean), by the cell's group: [(group * components + m) * dimension + k]
  std::vector<double> duals;
  double error = 0;  // weighted mean over cells of the square of the metric's distance

  // weights[cell * components + m] of values[cell * stride + k], cells of these groups.
  std::vector<float> project(std::span<const float> values, std::size_t stride,
                             std::span<const std::uint16_t> group_of_cell) const;
};

// Cells in groups, each with its metric.
struct GroupMetrics {
  std::span<const std::uint16_t> group_of_cell;
  std::span<const double> metrics;  // [(group * dimension + i) * dimension + k]: symmetric, positive definite
};

// values, stride, cell_weights: as of principal_components, which also gave `start`: the mean, and a first guess of
// vectors. As many components as that has, and it must leave something: a tail above 0. Vectors are
// orthonormal in the mean metric, most variance of weights first, signs as of principal_components. Fewer components
// are not the first of more.
WeightedComponents weighted_components(std::span<const float> values, std::size_t stride,
                                       std::span<const float> cell_weights, const GroupMetrics& metrics,
                                       const PrincipalComponents& start);

// The cells' mean metric, weighted: [i * dimension + k]. No cell of positive weight: of all groups.
std::vector<double> mean_metric(const GroupMetrics& metrics, std::span<const float> cell_weights,
                                std::size_t dimension);

}  // namespace twinshade
