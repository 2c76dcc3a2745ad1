#include "cpu_shaders/lint/tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/error.h"
#include "cpu_shaders/source/preprocess.h"

namespace twinshade::lint_detail {
namespace {

constexpr std::array<std::string_view, 23> kLongSymbols = {
    "<<=", ">>=", "++", "--", "<=", ">=", "==", "!=", "&&", "||", "^^", "<<",
    ">>",  "+=",  "-=", "*=", "/=", "%=", "&=", "|=", "^=", "::", "->"};

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// A number's end: digits, letters, points, and signs right behind a decimal exponent's e.
std::size_t number_end(const std::string& text, std::size_t at) {
  const bool hexadecimal = text.compare(at, 2, "0x") == 0 || text.compare(at, 2, "0X") == 0;
  std::size_t end = at + 1;
  while (end < text.size()) {
    const char before = text[end - 1];
    const bool sign = (text[end] == '+' || text[end] == '-') && (before == 'e' || before == 'E') && !hexadecimal;
    if (!is_name(text[end]) && text[end] != '.' && !sign) break;
    ++end;
  }
  return end;
}

class Tokenizer {
 public:
  Tokenizer(const std::string& text, const std::string& main_file) : text_(text) { list_.files.push_back(main_file); }

  TokenList run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        ++at_;
        line_start_ = true;
      } else if (std::isspace(static_cast<unsigned char>(c))) {
        ++at_;
      } else if (c == '#' && line_start_) {
        directive();
      } else {
        line_start_ = false;
        token();
      }
    }
    add(Token::Kind::end, 0);
    return std::move(list_);
  }

 private:
  void add(Token::Kind kind, std::size_t length) {
    list_.tokens.push_back({kind, text_.substr(at_, length), file_, line_});
    at_ += length;
  }

  void token() {
    const char c = text_[at_];
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (is_digit(c) || (c == '.' && is_digit(next))) {
      add(Token::Kind::number, number_end(text_, at_) - at_);
    } else if (is_name(c)) {
      std::size_t end = at_;
      while (end < text_.size() && is_name(text_[end])) ++end;
      add(Token::Kind::name, end - at_);
    } else {
      const auto match = std::find_if(kLongSymbols.begin(), kLongSymbols.end(), [&](std::string_view symbol) {
        return text_.compare(at_, symbol.size(), symbol) == 0;
      });
      add(Token::Kind::symbol, match == kLongSymbols.end() ? 1 : match->size());
    }
  }

  // #line N ["file"]: the next line is line N. Every other directive that is left has no code.
  void directive() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string line = text_.substr(at_, end - at_);
    at_ = end;
    const std::size_t word = line.find_first_not_of("# \t");
    if (word != std::string::npos && line.compare(word, 9, "extension") == 0 &&
        line.find("GL_GOOGLE_cpp_style_line_directive") == std::string::npos)
      list_.extensions.push_back(line);
    std::size_t number = line.find("line");
    if (number == std::string::npos || line.find_first_not_of("# \t") != number) return;
    number = line.find_first_of("0123456789", number);
    if (number == std::string::npos) return;
    line_ = std::stoi(line.substr(number)) - 1;
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open == close) return;
    const std::string file = line.substr(open + 1, close - open - 1);
    const auto known = std::find(list_.files.begin(), list_.files.end(), file);
    file_ = static_cast<int>(known - list_.files.begin());
    if (known == list_.files.end()) list_.files.push_back(file);
  }

  const std::string& text_;
  TokenList list_;
  std::size_t at_ = 0;
  int file_ = 0, line_ = 1;
  bool line_start_ = true;
};

}  // namespace

TokenList tokenize(const ShaderSource& source) {
  const std::string text = preprocess(source);
  return Tokenizer(text, source.files.at(0)).run();
}

}  // namespace twinshade::lint_detail
