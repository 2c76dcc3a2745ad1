#include "cpu_shaders/source/directive_scan.h"

#include <cctype>

namespace twinshade {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\n'; }

std::string trimmed(const std::string& text) {
  std::size_t first = 0, last = text.size();
  while (first < last && is_space(text[first])) ++first;
  while (last > first && is_space(text[last - 1])) --last;
  return text.substr(first, last - first);
}

void recognise_directive(const std::string& code, SourceLine& line) {
  const std::string body = trimmed(code);
  if (body.empty() || body[0] != '#') return;
  const std::string after_hash = trimmed(body.substr(1));
  std::size_t length = 0;
  while (length < after_hash.size() && std::isalpha(static_cast<unsigned char>(after_hash[length]))) ++length;
  line.directive = after_hash.substr(0, length);
  line.arguments = trimmed(after_hash.substr(length));
}

}  // namespace

std::vector<SourceLine> scan_lines(std::string_view text) {
  std::vector<SourceLine> lines;
  bool in_block_comment = false;
  std::size_t at = 0;
  int number = 1;
  while (at < text.size()) {
    SourceLine line;
    line.number = number;
    std::string code;  // the line without its comments
    bool in_line_comment = false;
    for (; at < text.size(); ++at) {
      const char c = text[at];
      const char next = at + 1 < text.size() ? text[at + 1] : '\0';
      if (c == '\\' && next == '\n') {
        line.text += "\\\n";
        ++at, ++number;
        continue;
      }
      if (c == '\n') break;
      line.text += c;
      if (in_block_comment) {
        if (c == '*' && next == '/') {
          line.text += next;
          ++at;
          in_block_comment = false;
          code += ' ';
        }
      } else if (!in_line_comment) {
        if (c == '/' && next == '*') {
          line.text += next;
          ++at;
          in_block_comment = true;
        } else if (c == '/' && next == '/') {
          in_line_comment = true;
        } else {
          code += c;
        }
      }
    }
    ++at, ++number;
    recognise_directive(code, line);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace twinshade
