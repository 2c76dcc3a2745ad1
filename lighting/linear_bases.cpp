#include "lighting/linear_bases.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> to_vector(const Matrix& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

Matrix to_matrix(const std::vector<double>& values, int rows, int columns) {
  return Eigen::Map<const Matrix>(values.data(), rows, columns);
}

void require_linear(const TechniqueInfo& technique) {
  if (!technique.is_basis || !technique.linear)
    throw UserError("technique " + std::string(technique.name) + " is not a linear basis: it has no matrices");
}

// What is left of exact zeros and ones after a quadrature is noise: cleared, so that sparse matrices stay sparse.
void clear_noise(std::vector<double>& matrix) {
  double largest = 0;
  for (const double value : matrix) largest = std::max(largest, std::abs(value));
  for (double& value : matrix)
    if (std::abs(value) < 1e-13 * largest) value = 0;
}

// Sum over the points of weight * a_i * b_j.
Matrix moments(const Quadrature& points, const std::vector<double>& a, int a_count, const std::vector<double>& b,
               int b_count) {
  Matrix sum = Matrix::Zero(a_count, b_count);
  for (std::size_t p = 0; p < points.weights.size(); ++p)
    for (int i = 0; i < a_count; ++i) {
      const double weighted = points.weights[p] * a[p * a_count + i];
      for (int j = 0; j < b_count; ++j) sum(i, j) += weighted * b[p * b_count + j];
    }
  return sum;
}

Matrix solve_gram(const TechniqueInfo& basis, const Matrix& gram, const Matrix& right) {
  const Eigen::LLT<Matrix> factors(gram);
  if (factors.info() != Eigen::Success)
    throw UserError("basis " + std::string(basis.name) +
                    ": its functions depend on each other over the domain: no least-squares fit");
  return factors.solve(right);
}

// C of eq. 7. The outer integral takes a coarser rule: the inner one is smooth in n.
Matrix cosine_matrix(const TechniqueInfo& basis) {
  const Quadrature outer = icosahedral_quadrature(4);
  const Quadrature& inner = domain_quadrature(Domain::sphere);
  const std::vector<double> b = basis_values(basis, outer.directions), w = basis_values(basis, inner.directions);
  const int count = basis.count;
  const std::size_t rows = outer.weights.size();
  std::vector<double> lit(rows * count, 0.0);  // irradiance at outer point p under radiance b_j
  constexpr std::size_t kRowsAtOnce = 16;
  parallel_for((rows + kRowsAtOnce - 1) / kRowsAtOnce, [&](std::size_t block, int) {
    for (std::size_t p = block * kRowsAtOnce; p < std::min(rows, (block + 1) * kRowsAtOnce); ++p)
      for (std::size_t q = 0; q < inner.weights.size(); ++q) {
        const double cosine = glm::dot(outer.directions[p], inner.directions[q]);
        if (!(cosine > 0)) continue;
        const double weighted = cosine * inner.weights[q];
        for (int j = 0; j < count; ++j) lit[p * count + j] += weighted * w[q * count + j];
      }
  });
  return moments(outer, b, count, lit, count);
}

}  // namespace

Domain projection_domain(const TechniqueInfo& basis) {
  return basis.domain == Domain::hemisphere ? Domain::hemisphere : Domain::sphere;
}

std::vector<double> moment_matrix(const TechniqueInfo& a, const TechniqueInfo& b, Domain domain) {
  require_linear(a);
  require_linear(b);
  const Quadrature& points = domain_quadrature(domain);
  return to_vector(
      moments(points, basis_values(a, points.directions), a.count, basis_values(b, points.directions), b.count));
}

std::vector<double> gram_matrix(const TechniqueInfo& basis, Domain domain) {
  return moment_matrix(basis, basis, domain);
}

double condition_number(std::span<const double> symmetric, int n) {
  TWINSHADE_CHECK_EQ(symmetric.size(), std::size_t(n) * n);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(Eigen::Map<const Matrix>(symmetric.data(), n, n),
                                                     Eigen::EigenvaluesOnly);
  const double smallest = solver.eigenvalues()(0), largest = solver.eigenvalues()(n - 1);
  return smallest > 0 ? largest / smallest : std::numeric_limits<double>::infinity();
}

std::vector<double> basis_operator(const TechniqueInfo& from, const TechniqueInfo& to, Domain domain) {
  const Matrix gram = to_matrix(gram_matrix(to, domain), to.count, to.count);
  std::vector<double> result =
      to_vector(solve_gram(to, gram, to_matrix(moment_matrix(to, from, domain), to.count, from.count)));
  clear_noise(result);
  return result;
}

std::vector<double> operator_from_radiance(const TechniqueInfo& basis) {
  require_linear(basis);
  const std::array<double, kMostRadianceCount> cosine = clamped_cosine_factors();
  std::vector<double> matrix;
  int columns = kRadianceCount;
  switch (basis.projection) {
    case Projection::value_at_normal: {
      TWINSHADE_CHECK_EQ(basis.count, 1);
      const glm::dvec3 normal(0, 0, 1);
      matrix = radiance_basis({&normal, 1});
      break;
    }
    case Projection::through_sh3:
      columns = 9;
      [[fallthrough]];
    case Projection::least_squares:
      matrix = basis_operator(find_technique("sh5"), basis);
      break;
    case Projection::truncation:
      matrix = basis_operator(find_technique("sh5"), basis, Domain::sphere);
      break;
    default:
      throw UserError("basis " + std::string(basis.name) + ": its projection is more than a matrix from radiance");
  }
  for (int i = 0; i < basis.count; ++i)
    for (int j = 0; j < kRadianceCount; ++j) {
      double& value = matrix[std::size_t(i) * kRadianceCount + j];
      value = j < columns ? value * cosine[j] : 0;
    }
  return matrix;
}

std::vector<double> irradiance_from_coefficients(const TechniqueInfo& basis) {
  const Matrix gram = to_matrix(gram_matrix(basis, Domain::sphere), basis.count, basis.count);
  return to_vector(solve_gram(basis, gram, cosine_matrix(basis)));
}

std::vector<double> irradiance_from_moments(const TechniqueInfo& basis) {
  const Matrix gram = to_matrix(gram_matrix(basis, Domain::sphere), basis.count, basis.count);
  const Matrix once = solve_gram(basis, gram, cosine_matrix(basis));
  // (G^-1 C) G^-1 = (G^-1 (G^-1 C)^T)^T, G being symmetric
  return to_vector(solve_gram(basis, gram, once.transpose()).transpose());
}

}  // namespace twinshade
