// Text of unknown origin, in documents that must be UTF-8 and on terminals.
#pragma once

#include <string>
#include <string_view>

namespace twinshade {

// What is no character of UTF-8 (RFC 3629: none too long, no surrogates), or one that XML 1.0 has no form for, becomes
// U+FFFD, byte by byte.
std::string with_characters_alone(std::string_view text);

// The same as text of an XML or HTML document, or between the double quotes of an attribute.
std::string xml_escaped(std::string_view text);

// One line for a terminal: line breaks and tabs become spaces, none at the end; other control characters, which move
// the cursor or change colours, U+FFFD. All else is kept, as names of files that are not UTF-8.
std::string one_line(std::string_view text);

}  // namespace twinshade
