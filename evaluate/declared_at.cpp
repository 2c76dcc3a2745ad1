#include "evaluate/declared_at.h"

#include <algorithm>
#include <charconv>

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

// Comments become spaces; lines stay lines.
std::string without_comments(std::string text) {
  enum class In { code, line, block } in = In::code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool at_start = i == 0 || text[i - 1] == '\n';
    if (in == In::code && at_start && text.compare(i, 6, "#line ") == 0) {  // a path may hold //
      i = text.find('\n', i);
      if (i == std::string::npos) break;
    }
    const std::string_view two = std::string_view(text).substr(i, 2);
    if (in == In::code && two == "//") in = In::line;
    if (in == In::code && two == "/*") in = In::block, text[i++] = ' ';
    if (in == In::block && two == "*/") in = In::code, text[i] = text[i + 1] = ' ';
    if (text[i] == '\n' && in == In::line) in = In::code;
    if (in != In::code && text[i] != '\n') text[i] = ' ';
  }
  return text;
}

bool follows(std::string_view text, std::size_t at, std::string_view kind) {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t' || text[at - 1] == '\n')) --at;
  const std::size_t end = at;
  while (at > 0 && is_word_character(text[at - 1])) --at;
  return text.substr(at, end - at).find(kind) != text.npos;
}

// As the #line directives that load_shader() writes before it tell.
std::string place_of(const ShaderSource& source, std::string_view text, std::size_t at) {
  std::string file = source.files.empty() ? source.name : source.files[0];
  int line = 1;
  for (std::size_t start = 0; start <= at;) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (end >= at) break;
    const std::string_view row = text.substr(start, end - start);
    int told = 0;
    if (row.substr(0, 6) == "#line " &&
        std::from_chars(row.data() + 6, row.data() + row.size(), told).ec == std::errc()) {
      line = told;
      const std::size_t open = row.find('"'), close = row.rfind('"');
      if (close != open) file = row.substr(open + 1, close - open - 1);
    } else {
      ++line;
    }
    start = end + 1;
  }
  return file + ":" + std::to_string(line);
}

}  // namespace

std::string declared_at(const ShaderSource& source, std::string_view name, std::string_view kind) {
  const std::string text = without_comments(source.text);
  const std::size_t first = find_word(text, name);
  std::size_t at = first;
  while (at != std::string::npos && !follows(text, at, kind)) at = find_word(text, name, at + 1);
  if (first == std::string::npos) return source.files.empty() ? source.name : source.files[0];
  return place_of(source, text, at == std::string::npos ? first : at);
}

}  // namespace twinshade
