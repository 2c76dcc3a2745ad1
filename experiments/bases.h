// Which bases an experiment measures, and their functions as matrices.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <glm/glm.hpp>

#include "experiments/experiment.h"
#include "lighting/registry.h"

namespace twinshade {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The bases that options.bases names (every basis of the registry where it names none) and `why_not` gives no reason
// against (empty: measured). A basis that was asked for by name and cannot be measured is a UserError with the reason,
// a name that does not exist one with the nearest names of those that can.
std::vector<const TechniqueInfo*> chosen_bases(const ExperimentOptions& options,
                                               const std::function<std::string(const TechniqueInfo&)>& why_not);

bool is_hemispherical(const TechniqueInfo& basis);

// A linear basis' functions at each direction, one row a direction.
Matrix basis_matrix(const TechniqueInfo& basis, const std::vector<glm::dvec3>& directions);

}  // namespace twinshade
