// glslang: GLSL to SPIR-V, not optimised, with debug lines.
#pragma once

#include <cstdint>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// GLSL 330-460 and ES 300-320. UserError with glslang's first message, at the
// author's file and line.
std::vector<std::uint32_t> compile_glsl(const ShaderSource& source);

}  // namespace twinshade
