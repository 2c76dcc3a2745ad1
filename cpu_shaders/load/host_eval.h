// Host code that needs a basis function runs its translation, in double.
#pragma once

#include <string_view>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

// Values of a linear basis' functions at directions (x y z triples, in the basis' frame): row-major [direction][function].
// number: float64, or scalar for what the shader itself computes in float. UserError where the technique is no linear basis.
std::vector<double> evaluate_basis(std::string_view technique, const std::vector<double>& directions_xyz,
                                   Number number = Number::float64);

// Runs a module whose inputs are float components over rows of host data. inputs: component-major
// [component * rows + row], in the order of ShaderVariable::first_component; the result likewise, of the outputs.
// number: scalar or float64 (float64 keeps every digit, scalar rounds the inputs to float first). The module must need no
// resources.
std::vector<double> run_module(const ShaderModule& module, Number number, const std::vector<double>& inputs,
                               std::size_t rows);

}  // namespace twinshade
