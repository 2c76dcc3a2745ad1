#include "cpu_shaders/translate/extra_semicolons.h"

#include <string_view>
#include <vector>

#include "cpu_shaders/source/glsl_pieces.h"

namespace twinshade {

bool is_about_extra_semicolon(const std::string& complaint) {
  return complaint.find("extraneous semicolon") != std::string::npos;
}

std::string without_extra_semicolons(std::string text) {
  const std::string original = text;
  const std::vector<std::string_view> pieces = pieces_of(original);
  int depth = 0;
  // Between declarations, where one is empty: at the beginning, behind another's semicolon, behind a body.
  bool is_between = true, is_body = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string_view piece = pieces[i];
    if (piece == "{" && depth++ == 0) is_body = i > 0 && pieces[i - 1] == ")";
    if (piece == "}") --depth;
    if (piece == ";" && depth == 0 && is_between) text[std::size_t(piece.data() - original.data())] = ' ';
    is_between = depth == 0 && (piece == ";" || (piece == "}" && is_body));
  }
  return text;
}

}  // namespace twinshade
