// Integer constant expressions, as array sizes and layout values use them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::gl {

// Value of tokens [begin, end): literals, names in `constants`, + - * / % and parentheses. Nothing where it is anything
// else.
std::optional<long> constant_integer(const std::vector<Token>& tokens, std::size_t begin, std::size_t end,
                                     const std::map<std::string, long>& constants);

}  // namespace twinshade::gl
