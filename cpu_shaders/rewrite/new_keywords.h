// Names of a shader in an older version of GLSL that are keywords or built-in functions in 4.50.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade {

// The tokens that are such names, wherever they stand; those in layout(...), where some of the words have their own
// meaning, are none.
std::vector<std::size_t> new_keyword_tokens(const std::vector<Token>& tokens, const ShaderSource& source);

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source);

// Functions that the shader declares itself, main among them, and the token where each is first named.
std::map<std::string, std::size_t> declared_functions(const std::vector<Token>& tokens);

// Those that became built-in ones later: in 4.50 they would be overloads of those, which may have another result or fit
// a call better.
std::set<std::string> new_functions(const std::vector<Token>& tokens, const ShaderSource& source);

}  // namespace twinshade
