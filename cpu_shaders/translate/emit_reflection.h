// The end of a translated file: tables of the shader's inputs, outputs, uniforms and resources, its entries, its module.
#pragma once

#include "cpu_shaders/translate/translate.h"

namespace twinshade::spirv {

// What follows the shader's class. identifier: for symbols. code_elsewhere: there is none, and so no entries.
std::string reflection_text(const Reflection& reflection, const ShaderSource& source, const std::string& identifier,
                            bool code_elsewhere);

}  // namespace twinshade::spirv
