#include "experiments/bases.h"

#include <algorithm>

#include "base/error.h"
#include "base/names.h"
#include "lighting/radiance_basis.h"

namespace twinshade {

std::vector<const TechniqueInfo*> chosen_bases(const ExperimentOptions& options,
                                               const std::function<std::string(const TechniqueInfo&)>& why_not) {
  std::vector<const TechniqueInfo*> chosen;
  std::vector<std::string> measured;
  for (const TechniqueInfo& basis : techniques())
    if (basis.is_basis && why_not(basis).empty()) measured.emplace_back(basis.name);
  for (const std::string& name : options.bases) {
    if (std::none_of(techniques().begin(), techniques().end(), [&](const auto& t) { return t.name == name; }))
      throw UserError(unknown_name_message("basis", name, measured));
    const TechniqueInfo& basis = find_technique(name);
    const std::string reason = basis.is_basis ? why_not(basis) : "it is a technique, not a basis";
    if (!reason.empty()) throw UserError("basis " + name + " cannot be measured by this experiment: " + reason);
    if (std::find(chosen.begin(), chosen.end(), &basis) == chosen.end()) chosen.push_back(&basis);
  }
  if (options.bases.empty())
    for (const std::string& name : measured) chosen.push_back(&find_technique(name));
  return chosen;
}

bool is_hemispherical(const TechniqueInfo& basis) { return basis.domain == Domain::hemisphere; }

Matrix basis_matrix(const TechniqueInfo& basis, const std::vector<glm::dvec3>& directions) {
  const std::vector<double> values = basis_values(basis, directions);
  return Eigen::Map<const Matrix>(values.data(), Eigen::Index(directions.size()), basis.count);
}

}  // namespace twinshade
