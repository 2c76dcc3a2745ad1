// Splits GLSL into lines and recognises preprocessor directives, aware of comments and of lines continued by a
// backslash.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twinshade {

struct SourceLine {
  int number = 0;         // of its first physical line, from 1
  std::string text;       // as written; contains "\\\n" where a backslash continues it
  std::string code;       // without comments and the backslashes that continue it
  std::string directive;  // "include", "if" ...; empty where the line is none
  std::string arguments;  // after the directive's name, comments removed, trimmed
  std::string comments;   // the text without its code
};

std::vector<SourceLine> scan_lines(std::string_view text);

}  // namespace twinshade
