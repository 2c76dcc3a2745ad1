#include "cpu_shaders/translate/precise_words.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/source/glsl_pieces.h"

namespace twinshade {
namespace {

constexpr std::string_view kPrecise = "precise";

bool may_stand_before(std::string_view piece) {
  constexpr std::array<std::string_view, 20> kBefore = {";",         "{",        "}",     "(",       ")",
                                                        ",",         ":",        "const", "in",      "out",
                                                        "inout",     "centroid", "flat",  "smooth",  "noperspective",
                                                        "invariant", "sample",   "highp", "mediump", "lowp"};
  return std::find(kBefore.begin(), kBefore.end(), piece) != kBefore.end();
}

}  // namespace

std::string without_precise(const ShaderSource& source, std::string text) {
  if (source.es || find_word(text, kPrecise) == text.npos) return text;
  const std::string original = text;
  const std::vector<std::string_view> pieces = pieces_of(original);
  for (std::size_t i = 0; i + 2 < pieces.size(); ++i) {
    if (pieces[i] != kPrecise || (i > 0 && !may_stand_before(pieces[i - 1]))) continue;
    const std::string_view type = pieces[i + 1], behind = pieces[i + 2];
    if (!is_word_character(type[0])) continue;
    const bool declares = is_word_character(behind[0]) || behind == "[" || (type == "layout" && behind == "(") ||
                          (type == "struct" && behind == "{");
    if (declares) text.replace(std::size_t(pieces[i].data() - original.data()), kPrecise.size(), kPrecise.size(), ' ');
  }
  return text;
}

bool may_lose_itself(const std::string& text) {
  return find_word(text, kPrecise) != text.npos && find_word(text, "struct") != text.npos;
}

}  // namespace twinshade
