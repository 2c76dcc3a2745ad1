// A basis' irradiance for rows of directions and coefficients, by its own GLSL.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"
#include "lighting/registry.h"

namespace twinshade {

class IrradianceModule {
 public:
  // UserError where `basis` is no basis, or its file reads uniforms, textures or inputs of its own. include_folders: as
  // for basis_irradiance_source.
  IrradianceModule(const TechniqueInfo& basis, Number number, const std::vector<std::string>& include_folders = {});

  // direction(row) gives something with .x .y .z; coefficient(row, i, c) channel c of coefficient i. Returns [row * 3 +
  // c].
  template <class Direction, class Coefficient>
  std::vector<double> run(std::size_t rows, const Direction& direction, const Coefficient& coefficient) const {
    std::vector<double> inputs(components_ * rows, 0.0);
    if (direction_ >= 0)
      for (std::size_t row = 0; row < rows; ++row) {
        const auto& d = direction(row);
        double* at = inputs.data() + std::size_t(direction_) * rows + row;
        at[0] = d.x, at[rows] = d.y, at[2 * rows] = d.z;
      }
    if (coefficients_ >= 0)
      for (int i = 0; i < count_; ++i)
        for (int c = 0; c < 3; ++c) {
          double* at = inputs.data() + (std::size_t(coefficients_) + i * 3 + c) * rows;
          for (std::size_t row = 0; row < rows; ++row) at[row] = coefficient(row, i, c);
        }
    return irradiance(inputs, rows);
  }

 private:
  std::vector<double> irradiance(const std::vector<double>& inputs, std::size_t rows) const;

  const ShaderModule* module_;
  Number number_;
  int count_;
  std::size_t components_;
  std::ptrdiff_t direction_ = -1, coefficients_ = -1;  // first components; -1: the shader does not read it
  std::size_t irradiance_ = 0;
};

}  // namespace twinshade
