#include "cpu_shaders/package/declaration_order.h"

#include <algorithm>
#include <cctype>

namespace twinshade {
namespace {

bool is_word(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); }

// Where a comment that starts at `at` ends; `at` if none does.
std::size_t skip_comment(const std::string& text, std::size_t at) {
  if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
  if (text.compare(at, 2, "/*") != 0) return at;
  const std::size_t end = text.find("*/", at + 2);
  return end == std::string::npos ? text.size() : end + 2;
}

}  // namespace

std::vector<std::string> declared_names(const std::string& glsl) {
  std::vector<std::string> names;
  bool declares = false;
  for (std::size_t at = 0; at < glsl.size();) {
    if (const std::size_t end = skip_comment(glsl, at); end != at) {
      at = end;
      continue;
    }
    const std::size_t start = at;
    while (at < glsl.size() && is_word(glsl[at])) ++at;
    if (at == start) {
      if (glsl[at] == ';' || glsl[at] == '{') declares = false;
      ++at;
      continue;
    }
    const std::string word = glsl.substr(start, at - start);
    if (word == "in" || word == "out" || word == "uniform" || word == "buffer")
      declares = true;
    else if (declares && std::find(names.begin(), names.end(), word) == names.end())
      names.push_back(word);
  }
  return names;
}

}  // namespace twinshade
