#include "cpu_shaders/rewrite/exact_names.h"

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

void replace_word(std::string& text, const std::string& word, const std::string& by) {
  for (std::size_t at = find_word(text, word); at != text.npos; at = find_word(text, word, at + by.size()))
    text.replace(at, word.size(), by);
}

}  // namespace

std::string path_in(const ExactShader& exact, std::string path) {
  for (const auto& [author, now] : exact.renamed) replace_word(path, author, now);
  return path;
}

std::string as_the_author_names(const ExactShader& exact, std::string text) {
  for (const auto& [author, now] : exact.renamed) replace_word(text, now, author);
  return text;
}

}  // namespace twinshade
