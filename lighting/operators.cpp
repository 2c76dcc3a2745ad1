// From baked radiance to a basis' coefficients: irradiance sum_j A_l L_j Y_j(n), fitted by least squares over the
// basis' domain (Habel and Wimmer, Efficient Irradiance Normal Mapping, I3D 2010, eq. 7, with the inverse Gram matrix
// that bases which are not orthonormal need).
#include <Eigen/Cholesky>
#include <cmath>

#include "base/error.h"
#include "lighting/bake.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

// Exact far beyond the degrees in use, and converging for bases that are not polynomials.
constexpr int kRings = 48;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> to_vector(const Matrix& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

}  // namespace

std::vector<double> operator_from_radiance(const TechniqueInfo& technique) {
  if (!technique.is_basis || !technique.linear)
    throw UserError("technique " + std::string(technique.name) +
                    " is not a linear basis: it has no matrix from radiance");
  const std::array<double, kRadianceCount> cosine = clamped_cosine_factors();

  if (technique.projection == Projection::value_at_normal) {
    TWINSHADE_CHECK_EQ(technique.count, 1);
    const glm::dvec3 normal(0, 0, 1);
    std::vector<double> row = radiance_basis({&normal, 1});
    for (int j = 0; j < kRadianceCount; ++j) row[j] *= cosine[j];
    return row;
  }

  const Quadrature points = sphere_quadrature(technique.projection == Projection::truncation ? -1 : 0, kRings);
  const std::vector<double> radiance = radiance_basis(points.directions);
  const std::vector<double> basis = basis_values(technique, points.directions);
  Matrix gram = Matrix::Zero(technique.count, technique.count);
  Matrix moments = Matrix::Zero(technique.count, kRadianceCount);
  for (std::size_t p = 0; p < points.weights.size(); ++p) {
    const double* b = basis.data() + p * technique.count;
    const double* y = radiance.data() + p * kRadianceCount;
    for (int i = 0; i < technique.count; ++i) {
      const double weighted = points.weights[p] * b[i];
      for (int k = 0; k < technique.count; ++k) gram(i, k) += weighted * b[k];
      for (int j = 0; j < kRadianceCount; ++j) moments(i, j) += weighted * y[j] * cosine[j];
    }
  }
  return to_vector(gram.llt().solve(moments));
}

}  // namespace twinshade
