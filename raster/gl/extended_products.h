// umulExtended and imulExtended where Mesa 22.3 knows a factor.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::gl {

// Mesa takes the 64 bits of a product by 1 for the other factor's 32, crashes where a factor has all bits set, and
// loses the high word where both are constants. So the calls go to functions of our own, whose factors it cannot know.
// True if there are any. Functions of the author's by those names have other ones already (author_names.h).
bool redirect_extended_products(std::vector<Token>& tokens);

// Those functions, to stand before the text, and the uniform that hides factors: always 0.
std::string extended_product_functions();
inline constexpr const char* kUnknownZero = "twinshade_unknown_zero";

}  // namespace twinshade::gl
