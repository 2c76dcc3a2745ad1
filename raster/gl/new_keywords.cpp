#include "raster/gl/new_keywords.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include "cpu_shaders/rewrite/keyword_versions.h"

namespace twinshade::gl {
namespace {

// Those outside layout(...), where some of the words have their own meaning.
std::vector<std::size_t> words(const std::vector<Token>& tokens) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text == "layout")
      while (i + 1 < tokens.size() && tokens[i].text != ")") ++i;
    if (tokens[i].kind == TokenKind::word) list.push_back(i);
  }
  return list;
}

// An extension may have made it a keyword all the same: qualifiers stand before other words, or as
// layout(std430) buffer;
bool is_name(const std::vector<Token>& tokens, std::size_t at) {
  if (at == 0 || at + 1 >= tokens.size() || tokens[at + 1].kind == TokenKind::word) return false;
  return tokens[at - 1].text != ")" || tokens[at + 1].text != ";";
}

}  // namespace

void rename_new_keywords(const ShaderSource& source, std::vector<Token>& tokens) {
  const std::vector<std::size_t> list = words(tokens);
  std::set<std::string> names;
  for (const KeywordVersion& word : kNewKeywords) {
    const auto names_something = [&](std::size_t at) { return tokens[at].text == word.name && is_name(tokens, at); };
    if (source.version < (source.es ? word.es_version : word.version) &&
        std::any_of(list.begin(), list.end(), names_something))
      names.insert(word.name);
  }
  for (const std::size_t at : list)
    if (names.count(tokens[at].text) != 0) tokens[at].text = kNamePrefix + tokens[at].text;
}

std::string author_name(std::string name) {
  const std::string_view prefix = kNamePrefix;
  const auto within_word = [&](std::size_t at) {
    return at > 0 && (std::isalnum(static_cast<unsigned char>(name[at - 1])) != 0 || name[at - 1] == '_');
  };
  for (std::size_t at = 0; (at = name.find(prefix, at)) != std::string::npos;)
    if (within_word(at))
      ++at;
    else
      name.erase(at, prefix.size());
  return name;
}

}  // namespace twinshade::gl
