// Names that a shader's author may use and that glslang would take for its own: before it reads them they get an
// ending, which its SPIR-V and its messages lose again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// The text of a shader in GLSL ES with an ending at each name that glslang takes for its own and that the version
// leaves free: functions of extensions, and for ES 300, which is translated as 310, what that made functions and
// keywords. Macros that the author calls so are expanded before.
std::string with_free_names_of_es(const ShaderSource& source);

// The text of a shader in desktop GLSL with an ending at each name of a function that hides built-in ones
// (hidden_built_ins.h): preprocessed then, else as it is.
std::string with_free_functions(const ShaderSource& source);

// The text of a shader with an ending at each variable and member called `length`, where a member is read that is:
// glslang takes it for the method of arrays. Preprocessed then, else as it is.
std::string with_free_members(const ShaderSource& source);

// SPIR-V whose names are the author's.
void drop_endings(std::vector<std::uint32_t>& words);

// A message that names things as the author does, and says so where a call may mean a built-in function that is hidden.
std::string without_endings(const std::string& message);

}  // namespace twinshade
