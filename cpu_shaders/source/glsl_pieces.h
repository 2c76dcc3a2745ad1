// GLSL in pieces that stay where they are, for small changes before glslang reads it.
#pragma once

#include <string_view>
#include <vector>

namespace twinshade {

// Words and other characters of GLSL that is not preprocessed, without comments and directives. Views of the text.
std::vector<std::string_view> pieces_of(std::string_view text);

}  // namespace twinshade
