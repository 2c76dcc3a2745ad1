#include "cpu_shaders/source/glsl_pieces.h"

#include "cpu_shaders/source/find_word.h"

namespace twinshade {

std::vector<std::string_view> pieces_of(std::string_view text) {
  std::vector<std::string_view> pieces;
  bool line_begins = true;
  for (std::size_t at = 0; at < text.size();) {
    const auto skip_to = [&](std::string_view end, std::size_t from) {
      const std::size_t found = text.find(end, from);
      at = found == text.npos ? text.size() : found + end.size();
    };
    const char c = text[at];
    if (c == '\n' || c == ' ' || c == '\t' || c == '\r') {
      line_begins |= c == '\n';
      ++at;
    } else if (text.substr(at, 2) == "/*") {
      skip_to("*/", at + 2);
    } else if (text.substr(at, 2) == "//" || (c == '#' && line_begins)) {
      do {  // a line may be joined with the next one
        skip_to("\n", at);
      } while (at < text.size() && at >= 2 && text[at - 2] == '\\');
      line_begins = true;
    } else {
      std::size_t end = at + 1;
      if (is_word_character(c))
        while (end < text.size() && is_word_character(text[end])) ++end;
      pieces.push_back(text.substr(at, end - at));
      line_begins = false;
      at = end;
    }
  }
  return pieces;
}

}  // namespace twinshade
