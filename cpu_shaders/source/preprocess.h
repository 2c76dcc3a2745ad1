// GLSL as its preprocessor leaves it: comments gone, macros expanded, conditionals decided; #version, #extension,
// #pragma and #line N "file" still there.
#pragma once

#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// By glslang's preprocessor: the one that the translation also goes through, so that all see the same tokens.
// UserError "file:line: message" for what it rejects.
std::string preprocess(const ShaderSource& source);
// The same for text that no translation has been through yet: in a child process first where it looks hostile.
std::string preprocess_untried(const ShaderSource& source);

}  // namespace twinshade
