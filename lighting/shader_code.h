// The part of a shader that is compiled.
#pragma once

#include <string>

namespace twinshade {

// GLSL without comments, which name coefficients as examples, and without #line, whose files may be called after them.
// Other directives stay: macros are how the built-in shaders name what they read.
std::string code_of(const std::string& text);

}  // namespace twinshade
