#include "cpu_shaders/rewrite/token_edits.h"

namespace twinshade::lint_detail {

TokenEdits::TokenEdits(const TokenList& list) : list_(list), before_(list.tokens.size()), behind_(list.tokens.size()) {
  for (const Token& token : list.tokens) text_.push_back(token.text);
}

void TokenEdits::parenthesize(std::size_t first, std::size_t last) {
  before(first, "(");
  behind(last - 1, ")");
}

void TokenEdits::collapse(std::size_t first, std::size_t last, const std::string& text) {
  for (std::size_t i = first; i < last; ++i) {
    before_[i].clear();
    text_[i].clear();
    behind_[i].clear();
  }
  text_[first] = text;
}

std::string TokenEdits::text(std::size_t first, std::size_t last) const {
  std::string joined;
  for (std::size_t i = first; i < last; ++i) joined += (joined.empty() ? "" : " ") + edited(i);
  return joined;
}

std::string TokenEdits::lines(const std::function<bool(const std::string& file)>& leave_out) const {
  constexpr int kBlankLines = 3;  // further away, #line is shorter
  std::string all;
  int file = -1, line = 0;
  for (std::size_t i = 0; i < list_.tokens.size(); ++i) {
    const Token& token = list_.tokens[i];
    const std::string text = edited(i);
    if (text.empty() || (leave_out && leave_out(list_.files[std::size_t(token.file)]))) continue;
    if (token.file == file && token.line >= line && token.line <= line + kBlankLines) {
      all.append(std::size_t(token.line - line), '\n');
      all += ' ';
    } else {
      all += "\n#line " + std::to_string(token.line) + " \"" + list_.files[std::size_t(token.file)] + "\"\n";
    }
    file = token.file;
    line = token.line;
    all += text;
  }
  return all + '\n';
}

std::string TokenEdits::head(const ShaderSource& source) const {
  std::string text;
  if (source.text.rfind("#version", 0) == 0) text = source.text.substr(0, source.text.find('\n') + 1);
  for (const std::string& extension : list_.extensions) text += extension + "\n";
  return text;
}

}  // namespace twinshade::lint_detail
