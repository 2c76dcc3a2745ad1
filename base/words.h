// Words of a text: runs of letters, digits and underscores.
#pragma once

#include <string_view>

namespace twinshade {

// Whether `word` stands in the text as a whole one.
bool contains_word(std::string_view text, std::string_view word);

}  // namespace twinshade
