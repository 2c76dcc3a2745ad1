#include "lighting/irradiance_module.h"

#include <string>
#include <string_view>

#include "base/error.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"

namespace twinshade {

IrradianceModule::IrradianceModule(const TechniqueInfo& basis, Number number,
                                   const std::vector<std::string>& include_folders)
    : module_(&load_module(basis_irradiance_source(basis, include_folders), number)),
      number_(number),
      count_(basis.count),
      components_(module_->input_components) {
  const auto refuse = [&](const std::string& what) {
    throw UserError("basis/" + std::string(basis.file) + " reads " + what +
                    ": a basis has its normal and, through COEF(i), its coefficients, nothing else");
  };
  if (module_->resource_count > 0 || module_->uniform_count > 0) refuse("uniforms, buffers or textures");
  for (std::uint32_t i = 0; i < module_->input_count; ++i) {
    const std::string_view name = module_->inputs[i].name;
    if (name != "direction" && name.rfind("coefficients", 0) != 0) refuse("the input " + std::string(name));
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
