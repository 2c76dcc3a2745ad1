#include "raster/gl/author_names.h"

#include <cctype>
#include <string_view>

#include "cpu_shaders/rewrite/new_keywords.h"
#include "cpu_shaders/source/hidden_built_ins.h"

namespace twinshade::gl {

void rename_new_words(const ShaderSource& source, std::vector<Token>& tokens) {
  std::vector<std::string_view> words;
  for (const Token& token : tokens) words.push_back(token.text);
  std::vector<std::size_t> places = names_of_hiding_functions(words);
  const std::vector<std::size_t> keywords = new_keyword_tokens(tokens, source);
  places.insert(places.end(), keywords.begin(), keywords.end());
  for (const std::size_t place : places) tokens[place].text = kNamePrefix + tokens[place].text;
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
