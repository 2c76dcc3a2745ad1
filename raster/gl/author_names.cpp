#include "raster/gl/author_names.h"

#include <cctype>
#include <set>
#include <string_view>

#include "cpu_shaders/rewrite/new_keywords.h"

namespace twinshade::gl {

void rename_new_words(const ShaderSource& source, std::vector<Token>& tokens) {
  const std::set<std::string> functions = new_functions(tokens, source);
  for (const std::size_t at : new_keyword_tokens(tokens, source)) tokens[at].text = kNamePrefix + tokens[at].text;
  for (Token& token : tokens)  // members and variables of that name, too: reflection has the author's
    if (functions.count(token.text) != 0) token.text = kNamePrefix + token.text;
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
