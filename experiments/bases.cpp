#include "experiments/bases.h"

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

}  // namespace twinshade
