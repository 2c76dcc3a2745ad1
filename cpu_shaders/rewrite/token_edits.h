// Changes to a shader's text as text put before, behind or in the place of its tokens, so that every token keeps the
// author's file and line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::lint_detail {

class TokenEdits {
 public:
  explicit TokenEdits(const TokenList& list);

  // Later insertions at one place go further out: an expression's operands are edited before it is.
  void before(std::size_t token, const std::string& text) { before_[token].insert(0, text); }
  void behind(std::size_t token, const std::string& text) { behind_[token] += text; }
  // Tokens [first, last) get parentheses around them.
  void parenthesize(std::size_t first, std::size_t last);
  void replace(std::size_t token, const std::string& text) { text_[token] = text; }
  // One text in the place of tokens [first, last) and of what was put around them.
  void collapse(std::size_t first, std::size_t last, const std::string& text);

  // Tokens [first, last) with their edits, on one line.
  std::string text(std::size_t first, std::size_t last) const;
  // All tokens but those of files that `leave_out` says, on the lines that #line gives them.
  std::string lines(const std::function<bool(const std::string& file)>& leave_out = {}) const;
  // What must stand before it: the author's #version and #extension lines.
  std::string head(const ShaderSource& source) const;

 private:
  std::string edited(std::size_t token) const { return before_[token] + text_[token] + behind_[token]; }

  const TokenList& list_;
  std::vector<std::string> before_, text_, behind_;
};

}  // namespace twinshade::lint_detail
