#include "experiments/basis_cost.h"

#include <algorithm>
#include <string_view>

#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"
#include "lighting/quadrature.h"

namespace twinshade {

BasisCost basis_cost(const TechniqueInfo& basis) {
  BasisCost cost;
  cost.coefficients = basis.count;
  const ShaderSource source = basis_irradiance_source(basis);
  cost.operations = count_operations(source, "basis_irradiance", "read_coefficient");

  const ShaderModule& module = load_module(source, Number::float64);
  const std::vector<glm::dvec3> directions =
      sphere_quadrature(basis.domain == Domain::hemisphere ? 0 : -1, 24).directions;
  // Which coefficients are read may depend on them: ones, no matter which
  std::vector<double> inputs(module.input_components * directions.size(), 1.0);
  for (std::uint32_t k = 0; k < module.input_count; ++k)
    if (std::string_view(module.inputs[k].name) == "direction")
      for (std::size_t row = 0; row < directions.size(); ++row)
        for (int c = 0; c < 3; ++c)
          inputs[(module.inputs[k].first_component + std::size_t(c)) * directions.size() + row] = directions[row][c];
  const std::vector<double> outputs = run_module(module, Number::float64, inputs, directions.size());
  for (std::uint32_t k = 0; k < module.output_count; ++k)
    if (std::string_view(module.outputs[k].name) == "reads") {
      const auto first = outputs.begin() + std::ptrdiff_t(module.outputs[k].first_component * directions.size());
      cost.reads = int(*std::max_element(first, first + std::ptrdiff_t(directions.size())));
    }
  return cost;
}

}  // namespace twinshade
