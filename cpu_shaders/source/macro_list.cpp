#include "cpu_shaders/source/macro_list.h"

#include <string>
#include <vector>

#include "cpu_shaders/source/directive_scan.h"
#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/source/glsl_pieces.h"

namespace twinshade {

bool is_list_of_macro_calls(std::string_view text) {
  std::string code;
  for (const SourceLine& line : scan_lines(text)) {
    if (line.directive == "pragma" && find_word(line.arguments, "once") == 0) return false;
    if (line.directive.empty()) code += line.code + '\n';
  }
  const std::vector<std::string_view> pieces = pieces_of(code);
  for (std::size_t i = 0; i < pieces.size();) {
    if (!is_word_character(pieces[i][0]) || i + 1 == pieces.size() || pieces[i + 1] != "(") return false;
    int depth = 0;
    do {
      if (++i == pieces.size()) return false;
      depth += (pieces[i] == "(") - (pieces[i] == ")");
    } while (depth > 0);
    ++i;
    if (i < pieces.size() && (pieces[i] == ";" || pieces[i] == ",")) ++i;
  }
  return !pieces.empty();
}

}  // namespace twinshade
