// The end of a translated file: tables of the shader's inputs, outputs, uniforms and resources, its entries, its module.
#pragma once

#include "cpu_shaders/translate/translate.h"

namespace twinshade::spirv {

// From the closing brace of the shader's class on. identifier: for symbols.
std::string reflection_text(const Reflection& reflection, const ShaderSource& source, const std::string& identifier);

}  // namespace twinshade::spirv
