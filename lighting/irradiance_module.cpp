#include "lighting/irradiance_module.h"

#include <string_view>

#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"

namespace twinshade {

IrradianceModule::IrradianceModule(const TechniqueInfo& basis, Number number,
                                   const std::vector<std::string>& include_folders)
    : module_(&load_module(basis_irradiance_source(basis, include_folders), number)),
      number_(number),
      count_(basis.count),
      components_(module_->input_components) {
  for (std::uint32_t i = 0; i < module_->input_count; ++i) {
    const std::string_view name = module_->inputs[i].name;
    (name == "direction" ? direction_ : coefficients_) = module_->inputs[i].first_component;
  }
  for (std::uint32_t i = 0; i < module_->output_count; ++i)
    if (std::string_view(module_->outputs[i].name) == "irradiance") irradiance_ = module_->outputs[i].first_component;
}

std::vector<double> IrradianceModule::irradiance(const std::vector<double>& inputs, std::size_t rows) const {
  const std::vector<double> columns = run_module(*module_, number_, inputs, rows);
  std::vector<double> values(rows * 3);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t row = 0; row < rows; ++row) values[row * 3 + c] = columns[(irradiance_ + c) * rows + row];
  return values;
}

}  // namespace twinshade
