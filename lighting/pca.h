// Principal components of a field of vectors, each with a weight: Sloan, Hall, Hart and Snyder, Clustered Principal
// Components for Precomputed Radiance Transfer, 2003, for one cluster; Iwanicki and Sloan, Normal Mapping with
// Low-Frequency Precomputed Visibility, JGT 2012, section 3.2.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace twinshade {

// value = mean + sum over m of weight_m * vector_m.
struct PrincipalComponents {
  std::size_t dimension = 0;
  std::vector<double> mean;         // [dimension]
  std::vector<double> vectors;      // [component * dimension + k]: orthonormal in the metric, most variance first
  std::vector<double> duals;        // the same through the metric: weight_m = dual_m . (value - mean)
  std::vector<double> eigenvalues;  // [dimension]: of the weighted covariance, none below zero, descending

  std::size_t count() const { return dimension == 0 ? 0 : vectors.size() / dimension; }
  // Mean squared error (weighted; the square of the metric's distance) of using the first `components`.
  double tail(std::size_t components) const;
  // weights[cell * components + m] of values[cell * stride + k], for the first `components` vectors.
  std::vector<float> project(std::span<const float> values, std::size_t stride, std::size_t components) const;
};

// values[cell * stride + k], k < dimension <= stride; cell_weights: not negative, cells of weight 0 do not count.
// components vectors are returned; those beyond the rank of the data, or beyond the dimension, are zero, so that their
// weights are zero too. A vector's sign: its component of largest magnitude is positive (the first of equals). No cell
// of positive weight: all is zero. UserError where a counted value is not finite.
// metric[i * dimension + k], symmetric and positive definite: the square of a difference d is d' metric d, and M
// components leave the least of that which M numbers a cell can. Empty: the sum of squares.
PrincipalComponents principal_components(std::span<const float> values, std::size_t stride, std::size_t dimension,
                                         std::span<const float> cell_weights, std::size_t components,
                                         std::span<const double> metric = {});

// weights[cell * components + m] = dual_m . (value - mean), the duals [m * dimension + k] of each cell from
// duals_of(cell).
std::vector<float> project_onto(std::span<const double> mean, std::size_t components,
                                const std::function<const double*(std::size_t cell)>& duals_of,
                                std::span<const float> values, std::size_t stride);

}  // namespace twinshade
