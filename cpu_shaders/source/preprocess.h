// GLSL as its preprocessor leaves it: comments gone, macros expanded, conditionals decided; #version, #extension,
// #pragma and #line N "file" still there.
#pragma once

#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// By glslang's preprocessor: the one that the translation also goes through, so that all see the same tokens.
// UserError "file:line: message" for what it rejects.
std::string preprocess(const ShaderSource& source);

}  // namespace twinshade
