#include "cpu_shaders/rewrite/new_keywords.h"

namespace twinshade::lint_detail {
namespace {

struct Keyword {
  const char* name;
  int version, es_version;  // that made it one
};

constexpr Keyword kKeywords[] = {
    {"sample", 400, 0},   {"patch", 400, 0},    {"subroutine", 400, 0}, {"precise", 400, 310}, {"coherent", 420, 0},
    {"restrict", 420, 0}, {"readonly", 420, 0}, {"writeonly", 420, 0},  {"buffer", 430, 310},
};

// An extension may have made it a keyword all the same: qualifiers stand before other names, or as
// layout(std430) buffer;
bool is_name(const TokenList& list, const std::string& word) {
  for (std::size_t i = 1; i + 1 < list.tokens.size(); ++i) {
    const Token &before = list.tokens[i - 1], &behind = list.tokens[i + 1];
    const bool qualifies = behind.kind == Token::Kind::name || (before.text == ")" && behind.text == ";");
    if (list.tokens[i].text == word && !qualifies) return true;
  }
  return false;
}

}  // namespace

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source) {
  std::set<std::string> names;
  for (const Keyword& word : kKeywords)
    if (source.version < (source.es ? word.es_version : word.version) && is_name(list, word.name))
      names.insert(word.name);
  return names;
}

}  // namespace twinshade::lint_detail
