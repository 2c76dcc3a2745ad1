// Names of a shader in an older version of GLSL that are keywords in 4.50.
#pragma once

#include <set>
#include <string>

#include "cpu_shaders/lint/tokens.h"

namespace twinshade::lint_detail {

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source);

}  // namespace twinshade::lint_detail
