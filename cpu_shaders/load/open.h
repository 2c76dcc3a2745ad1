// A module out of a compiled shared object.
#pragma once

#include <string>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

// The object stays loaded until the process ends. UserError naming `path` where it cannot be loaded or has no such
// symbol; the file is removed then.
const ShaderModule& open_module(const std::string& path, const std::string& symbol);

}  // namespace twinshade
