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
    const auto comment = [&line](const char* more) {
      line.text += more;
      line.comments += more;
    };
    for (; at < text.size(); ++at) {
      const char c = text[at];
      const char next = at + 1 < text.size() ? text[at + 1] : '\0';
      if (c == '\\' && next == '\n') {
        comment("\\\n");
        ++at, ++number;
        continue;
      }
      if (c == '\n') {
        // A comment is a space: a directive goes on where one ends that begins within it.
        if (!in_block_comment || trimmed(code).substr(0, 1) != "#") break;
        comment("\n");
        ++number;
        continue;
      }
      line.text += c;
      const bool opens = !in_block_comment && !in_line_comment && c == '/' && next == '*';
      const bool closes = in_block_comment && c == '*' && next == '/';
      in_line_comment = in_line_comment || (!in_block_comment && c == '/' && next == '/');
      if (!in_block_comment && !in_line_comment && !opens) {
        code += c;
        continue;
      }
      line.comments += c;
      if (opens || closes) {
        line.text += next;
        line.comments += next;
        ++at;
        in_block_comment = opens;
        if (closes) code += ' ';
      }
    }
    ++at, ++number;
    recognise_directive(code, line);
    line.code = std::move(code);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace twinshade
