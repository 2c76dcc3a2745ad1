#include "cpu_shaders/rewrite/new_keywords.h"

#include "cpu_shaders/rewrite/keyword_versions.h"

namespace twinshade::lint_detail {
namespace {

// An extension may have made it a keyword all the same: qualifiers stand before other names, or as
// layout(std430) buffer;
bool is_name(const TokenList& list, const std::string& word) {
  for (std::size_t i = 1; i + 1 < list.tokens.size(); ++i) {
    if (list.tokens[i].text == "layout")  // in which some of the words have their own meaning
      while (i + 2 < list.tokens.size() && list.tokens[i].text != ")") ++i;
    const Token &before = list.tokens[i - 1], &behind = list.tokens[i + 1];
    const bool qualifies = behind.kind == Token::Kind::name || (before.text == ")" && behind.text == ";");
    if (list.tokens[i].text == word && !qualifies) return true;
  }
  return false;
}

}  // namespace

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source) {
  std::set<std::string> names;
  for (const KeywordVersion& word : kNewKeywords)
    if (source.version < (source.es ? word.es_version : word.version) && is_name(list, word.name))
      names.insert(word.name);
  return names;
}

}  // namespace twinshade::lint_detail
