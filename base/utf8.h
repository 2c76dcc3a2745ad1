// Text of unknown origin in documents that must be UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace twinshade {

// What is no character of UTF-8 (RFC 3629: none too long, no surrogates), or one that XML 1.0 has no form for, becomes
// U+FFFD, byte by byte.
std::string with_characters_alone(std::string_view text);

}  // namespace twinshade
