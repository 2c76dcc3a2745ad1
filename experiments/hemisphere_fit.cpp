#include "experiments/hemisphere_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "lighting/linear_bases.h"
#include "lighting/radiance_basis.h"

namespace twinshade {

std::string why_not_hemispherical(const TechniqueInfo& basis) {
  if (basis.domain == Domain::sphere) return "it is of the sphere, not of the hemisphere";
  if (!basis.linear) return "it is not linear";
  return "";
}

HemisphereFit::HemisphereFit(const TechniqueInfo& basis, const Quadrature& points)
    : basis_(basis), projector_(basis, kRadianceCount), functions_(basis_matrix(basis, points.directions)) {
  if (!fits_samples()) return;
  Matrix weighted = functions_.transpose();
  for (Eigen::Index p = 0; p < weighted.cols(); ++p) weighted.col(p) *= points.weights[std::size_t(p)];
  Matrix gram = Matrix::Zero(basis.count, basis.count);
  for (Eigen::Index p = 0; p < weighted.cols(); ++p)
    for (int i = 0; i < basis.count; ++i)
      for (int k = 0; k < basis.count; ++k) gram(i, k) += weighted(i, p) * functions_(p, k);
  solution_ = gram.llt().solve(weighted);
}

Matrix HemisphereFit::coefficients(const SignalBlock& block) const {
  const Eigen::Index count = block.irradiance.cols();
  Matrix result = Matrix::Zero(basis_.count, count);
  if (fits_samples()) {
    for (Eigen::Index i = 0; i < result.rows(); ++i)
      for (Eigen::Index p = 0; p < solution_.cols(); ++p) {
        const double factor = solution_(i, p);
        for (Eigen::Index s = 0; s < count; ++s) result(i, s) += factor * block.irradiance(p, s);
      }
    return result;
  }
  for (Eigen::Index s = 0; s < count; ++s) {
    std::vector<double> radiance;
    for (int j = 0; j < kRadianceCount; ++j) radiance.push_back(block.radiance(j, s));
    const std::vector<double> one = from_radiance(radiance, block.flat[std::size_t(s)]);
    for (int i = 0; i < basis_.count; ++i) result(i, s) = one[std::size_t(i)];
  }
  return result;
}

std::vector<double> HemisphereFit::from_radiance(const std::vector<double>& radiance, double flat) const {
  if (basis_.projection == Projection::value_at_normal) return {flat};
  std::vector<double> grey, coefficients(std::size_t(basis_.count) * 3), one;
  for (const double value : radiance) grey.insert(grey.end(), 3, value);
  projector_.project(grey.data(), coefficients.data());
  for (std::size_t i = 0; i < coefficients.size(); i += 3) one.push_back(coefficients[i]);
  return one;
}

// E^2 - 2 c m + c G c integrated: each term over where it is smooth.
std::vector<ImpulseFit> fit_impulses(const HemisphereFit& fit, const Impulses& impulses) {
  const TechniqueInfo& basis = fit.basis();
  const Matrix values = basis_matrix(basis, impulses.points);
  const std::vector<double> radiance = radiance_basis(impulses.directions);
  const std::vector<double> gram_values = gram_matrix(basis, Domain::hemisphere);
  const Matrix gram = Eigen::Map<const Matrix>(gram_values.data(), basis.count, basis.count);
  const Eigen::LLT<Matrix> factors(gram);
  std::vector<ImpulseFit> fits;
  for (std::size_t i = 0; i < impulses.directions.size(); ++i) {
    double energy = 0;
    Eigen::VectorXd moments = Eigen::VectorXd::Zero(basis.count);
    for (std::size_t p = i * impulses.points_each; p < (i + 1) * impulses.points_each; ++p) {
      const double weighted = impulses.point_weights[p] * impulses.irradiance[p];
      energy += weighted * impulses.irradiance[p];
      for (int k = 0; k < basis.count; ++k) moments(k) += weighted * values(Eigen::Index(p), k);
    }
    Eigen::VectorXd coefficients;
    if (fit.fits_samples()) {
      coefficients = factors.solve(moments);
    } else {
      const auto light = radiance.begin() + std::ptrdiff_t(i * kRadianceCount);
      const std::vector<double> list = fit.from_radiance({light, light + kRadianceCount}, impulses.directions[i].z);
      coefficients = Eigen::Map<const Eigen::VectorXd>(list.data(), basis.count);
    }
    double error = energy;
    for (int k = 0; k < basis.count; ++k) {
      error -= 2 * coefficients(k) * moments(k);
      for (int m = 0; m < basis.count; ++m) error += coefficients(k) * gram(k, m) * coefficients(m);
    }
    fits.push_back({std::move(coefficients), std::max(error, 0.0)});
  }
  return fits;
}

}  // namespace twinshade
