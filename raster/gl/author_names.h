// Names that drivers would take for keywords, or that hide built-in functions, under others.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::gl {

// Words that became keywords after the shader's version are names that its author may use. Functions of his that hide
// built-in ones would hide them from the text that is generated around his, too. In the rewritten text both have this
// prefix.
inline constexpr const char* kNamePrefix = "twinshade_name_";

// Gives the prefix to those of the source's tokens that are such names.
void rename_new_words(const ShaderSource& source, std::vector<Token>& tokens);

// What the author calls a variable, a member or a block of the rewritten text: bundles, reflection, results and
// messages name it so.
std::string author_name(std::string name);

}  // namespace twinshade::gl
