#include "cpu_shaders/translate/source_lines.h"

#include <charconv>
#include <sstream>

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool has_word(const std::string& text, const std::string& word) { return find_word(text, word) != text.npos; }

// `#line 12 "file"`, the name optional: `number` becomes that of the line before the next. An author's other forms
// (macros, other spacing) are glslang's to judge.
bool read_line_directive(const std::string& text, int& number, std::string& file) {
  if (text.rfind("#line ", 0) != 0) return false;
  int given = 0;
  const auto [end, error] = std::from_chars(text.data() + 6, text.data() + text.size(), given);
  if (error != std::errc()) return false;
  number = given - 1;
  const std::string name = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  if (name.size() > 2 && name.front() == '"' && name.back() == '"') file = name.substr(1, name.size() - 2);
  return true;
}

// The line without comments; within_block: whether it begins, and then whether it ends, within /* */.
std::string code_of(const std::string& line, bool& within_block) {
  std::string code;
  for (std::size_t at = 0; at < line.size();) {
    if (within_block) {
      const std::size_t end = line.find("*/", at);
      if (end == line.npos) return code;
      within_block = false;
      code += ' ';
      at = end + 2;
    } else if (line.compare(at, 2, "//") == 0) {
      return code;
    } else if (line.compare(at, 2, "/*") == 0) {
      within_block = true;
      at += 2;
    } else {
      code += line[at++];
    }
  }
  return code;
}

}  // namespace

SourceLines::SourceLines(const ShaderSource& source) {
  std::istringstream lines(source.text);
  std::string text, file = source.files.empty() ? source.name : source.files[0];
  int number = 0;
  bool within_block = false;
  while (std::getline(lines, text)) {
    ++number;
    if (read_line_directive(text, number, file)) continue;
    lines_.push_back({file, trimmed(text), code_of(text, within_block), number});
    index_[{file, number}] = lines_.size() - 1;
  }
}

const std::string& SourceLines::text(const std::string& file, int line) const {
  static const std::string none;
  const auto found = index_.find({file, line});
  return found == index_.end() ? none : lines_[found->second].text;
}

std::size_t SourceLines::order(const Position& position) const {
  const auto found = index_.find({position.file, position.line});
  return found == index_.end() ? lines_.size() : found->second;
}

Position SourceLines::declaration(const std::string& name) const {
  const Line* mention = nullptr;
  for (const Line& line : lines_) {
    if (!has_word(line.code, name)) continue;
    for (const char* qualifier : {"uniform", "in", "out", "buffer", "layout", "flat", "const", "shared"})
      if (has_word(line.code, qualifier)) return {line.file, line.number};
    if (mention == nullptr) mention = &line;
  }
  if (mention != nullptr) return {mention->file, mention->number};
  return {lines_.empty() ? std::string("shader") : lines_.front().file, 1};
}

Position SourceLines::last() const {
  return lines_.empty() ? Position{"shader", 1} : Position{lines_.back().file, lines_.back().number};
}

Position SourceLines::mention(const std::vector<std::string>& words) const {
  for (const Line& line : lines_)
    for (const std::string& word : words)
      if (has_word(line.code, word)) return {line.file, line.number};
  return {lines_.empty() ? std::string("shader") : lines_.front().file, 1};
}

}  // namespace twinshade
