// gl_FragCoord as an input like any other, so that a row of values computes the same wherever it is drawn.
#pragma once

#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

inline constexpr const char* kRowFragCoord = "row_frag_coord";  // the added input, a vec4

// UserError where the shader is not valid GLSL.
ShaderSource frag_coord_as_input(const ShaderSource& source);

}  // namespace twinshade
