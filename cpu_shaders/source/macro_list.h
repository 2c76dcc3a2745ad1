// Files that are meant to be included again and again, with other macros each time ("X-macros").
#pragma once

#include <string_view>

namespace twinshade {

// Whether a file holds calls of macros and nothing else but directives: `LIGHT(sun, 2.0)` and so on. Not where it says
// `#pragma once`.
bool is_list_of_macro_calls(std::string_view text);

}  // namespace twinshade
