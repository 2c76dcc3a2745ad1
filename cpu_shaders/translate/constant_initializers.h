// glslang 12 folds some built-in functions of constants only (docs/glsl-support.md): `const mat3 b = transpose(a);` is
// no constant to it, and a global one is refused. Translated code computes them.
#pragma once

#include <string>

namespace twinshade {

// Whether a complaint is about such a constant.
bool is_about_constant_initializer(const std::string& complaint);

// The text with blanks in place of `const` before globals whose values such functions, or others of these globals, are
// part of. Every line and column stays.
std::string with_computed_constants(std::string text);

}  // namespace twinshade
