// Names that drivers would take for keywords or built-in functions, under others.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::gl {

// Words that became keywords after the shader's version are names that its author may use, those that became built-in
// functions are functions that he may write: in the rewritten text they have this prefix.
inline constexpr const char* kNamePrefix = "twinshade_name_";

// Gives the prefix to those of the source's tokens that are such names.
void rename_new_words(const ShaderSource& source, std::vector<Token>& tokens);

// What the author calls a variable, a member or a block of the rewritten text: bundles, reflection and results name it
// so.
std::string author_name(std::string name);

}  // namespace twinshade::gl
