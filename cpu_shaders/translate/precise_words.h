// glslang 12 carries `precise` backwards through a shader's assignments, and gets lost among structs: it looks for a
// member in an array of them, or follows `s = f(s.m)` and `s = c ? s : t` for ever, until no memory is left. To
// translated code the word means nothing: all of its arithmetic is as written. So glslang does not get to see it.
#pragma once

#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// The text with blanks in place of each `precise` that begins or qualifies a declaration with a type. Others stay:
// mistakes, `precise x;` of a variable that is there, what stands in macros, and all of GLSL ES, where it may be a
// name.
std::string without_precise(const ShaderSource& source, std::string text);

// Whether glslang may get lost: what without_precise returned has both words left.
bool may_lose_itself(const std::string& text);

}  // namespace twinshade
