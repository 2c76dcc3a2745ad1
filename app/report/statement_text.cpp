#include "app/report/statement_text.h"

namespace twinshade {
namespace {

constexpr std::size_t kMostLetters = 100;
constexpr int kMostLines = 40;

std::string without_comment(std::string text) {
  if (const std::size_t comment = text.find("//"); comment != text.npos) text.resize(comment);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.pop_back();
  return text;
}

bool ends_statement(const std::string& text) {
  return text.empty() || text.front() == '#' || std::string(";{}").find(text.back()) != std::string::npos;
}

}  // namespace

std::string statement_text(const SourceLines& lines, const std::string& file, int line) {
  const auto at = [&](int number) { return without_comment(lines.text(file, number)); };
  int first = line, last = line;
  while (first > 1 && line - first < kMostLines && !ends_statement(at(first - 1))) --first;
  while (last - line < kMostLines && !ends_statement(at(last))) ++last;
  std::string text;
  for (int number = first; number <= last; ++number)
    if (const std::string part = at(number); !part.empty()) text += (text.empty() ? "" : " ") + part;
  if (text.size() <= kMostLetters) return text;
  std::size_t cut = kMostLetters - 3;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0u) == 0x80u) --cut;  // not within a letter of UTF-8
  return text.substr(0, cut) + "...";
}

}  // namespace twinshade
