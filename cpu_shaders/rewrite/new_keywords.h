// Names of a shader in an older version of GLSL that are keywords in 4.50.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade {

// The tokens that are such names, wherever they stand; those in layout(...), where some of the words have their own
// meaning, are none.
std::vector<std::size_t> new_keyword_tokens(const std::vector<Token>& tokens, const ShaderSource& source);

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source);

}  // namespace twinshade
