#include "cpu_shaders/rewrite/new_keywords.h"

#include <algorithm>

namespace twinshade {
namespace {

struct KeywordVersion {
  const char* name;
  int version, es_version;  // that made it a keyword
};

constexpr KeywordVersion kNewKeywords[] = {
    {"sample", 400, 0},   {"patch", 400, 0},    {"subroutine", 400, 0}, {"precise", 400, 320}, {"coherent", 420, 0},
    {"restrict", 420, 0}, {"readonly", 420, 0}, {"writeonly", 420, 0},  {"buffer", 430, 310},  {"shared", 430, 310},
};

std::vector<std::size_t> names_outside_layout(const std::vector<Token>& tokens) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text == "layout")
      while (i + 1 < tokens.size() && tokens[i].text != ")") ++i;
    if (tokens[i].kind == Token::Kind::name) list.push_back(i);
  }
  return list;
}

// An extension may have made it a keyword all the same: qualifiers stand before other names, or as
// layout(std430) buffer;
bool qualifies(const std::vector<Token>& tokens, std::size_t at) {
  if (at == 0 || at + 1 >= tokens.size() || tokens[at + 1].kind == Token::Kind::name) return true;
  return tokens[at - 1].text == ")" && tokens[at + 1].text == ";";
}

}  // namespace

std::vector<std::size_t> new_keyword_tokens(const std::vector<Token>& tokens, const ShaderSource& source) {
  std::vector<std::size_t> found;
  const std::vector<std::size_t> names = names_outside_layout(tokens);
  for (const KeywordVersion& word : kNewKeywords) {
    if (source.version >= (source.es ? word.es_version : word.version)) continue;
    std::vector<std::size_t> uses;
    std::copy_if(names.begin(), names.end(), std::back_inserter(uses),
                 [&](std::size_t at) { return tokens[at].text == word.name; });
    if (!std::all_of(uses.begin(), uses.end(), [&](std::size_t at) { return qualifies(tokens, at); }))
      found.insert(found.end(), uses.begin(), uses.end());
  }
  return found;
}

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source) {
  std::set<std::string> names;
  for (const std::size_t at : new_keyword_tokens(list.tokens, source)) names.insert(list.tokens[at].text);
  return names;
}

}  // namespace twinshade
