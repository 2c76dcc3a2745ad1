#include "experiments/bases.h"

#include <Eigen/Eigenvalues>

#include "base/error.h"
#include "lighting/radiance_basis.h"

namespace twinshade {

std::vector<const TechniqueInfo*> chosen_bases(const ExperimentOptions& options,
                                               const std::function<std::string(const TechniqueInfo&)>& why_not) {
  std::vector<const TechniqueInfo*> chosen;
  for (const std::string& name : options.bases) {
    const TechniqueInfo& basis = find_technique(name);
    const std::string reason = basis.is_basis ? why_not(basis) : "it is a technique, not a basis";
    if (!reason.empty()) throw UserError("basis " + name + " cannot be measured by this experiment: " + reason);
    chosen.push_back(&basis);
  }
  if (options.bases.empty())
    for (const TechniqueInfo& basis : techniques())
      if (basis.is_basis && why_not(basis).empty()) chosen.push_back(&basis);
  return chosen;
}

bool is_hemispherical(const TechniqueInfo& basis) { return basis.domain == Domain::hemisphere; }

Matrix basis_matrix(const TechniqueInfo& basis, const std::vector<glm::dvec3>& directions) {
  const std::vector<double> values = basis_values(basis, directions);
  return Eigen::Map<const Matrix>(values.data(), Eigen::Index(directions.size()), basis.count);
}

Matrix weighted_product(const Matrix& a, const std::vector<double>& weights, const Matrix& b) {
  TWINSHADE_CHECK_EQ(a.rows(), b.rows());
  TWINSHADE_CHECK_EQ(std::size_t(a.rows()), weights.size());
  Matrix sum = Matrix::Zero(a.cols(), b.cols());
  for (Eigen::Index row = 0; row < a.rows(); ++row)
    for (Eigen::Index i = 0; i < a.cols(); ++i) {
      const double weighted = weights[std::size_t(row)] * a(row, i);
      for (Eigen::Index k = 0; k < b.cols(); ++k) sum(i, k) += weighted * b(row, k);
    }
  return sum;
}

double condition_number(const Matrix& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric, Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();  // ascending
  return values(values.size() - 1) / values(0);
}

}  // namespace twinshade
