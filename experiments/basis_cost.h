// What a basis costs to store and to evaluate.
#pragma once

#include "cpu_shaders/translate/count_operations.h"
#include "lighting/registry.h"

namespace twinshade {

struct BasisCost {
  int coefficients = 0;       // RGB, stored
  int reads = 0;              // RGB, read by one evaluation: the most over many directions
  OperationCount operations;  // of one basis_irradiance, three channels; reading costs nothing
};

// UserError where the technique is no basis.
BasisCost basis_cost(const TechniqueInfo& basis);

}  // namespace twinshade
