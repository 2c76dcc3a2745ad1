#include "cpu_shaders/source/glsl_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/source/preprocess.h"

namespace twinshade {
namespace {

constexpr std::array<std::string_view, 23> kLongSymbols = {
    "<<=", ">>=", "++", "--", "<=", ">=", "==", "!=", "&&", "||", "^^", "<<",
    ">>",  "+=",  "-=", "*=", "/=", "%=", "&=", "|=", "^=", "::", "->"};

bool is_white_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
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
  Tokenizer(const ShaderSource& source, const std::string& text) : text_(text) {
    list_.files = source.files;
    if (list_.files.empty()) list_.files.push_back(source.name);
    for (std::string& file : list_.files) file = line_name(file);
  }

  TokenList run() {
    bool line_start = true;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (is_white_space(c)) {
        before_ += c;
        ++at_;
        line_ += c == '\n';
        line_start = line_start || c == '\n';
      } else if (c == '#' && line_start) {
        directive();
      } else {
        line_start = false;
        list_.tokens.push_back(token());
      }
    }
    list_.end = {Token::Kind::end, "", std::move(before_), file_, line_};
    return std::move(list_);
  }

 private:
  Token token() {
    const char c = text_[at_];
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (is_digit(c) || (c == '.' && is_digit(next))) return take(Token::Kind::number, number_end(text_, at_) - at_);
    if (is_name(c)) {
      std::size_t end = at_;
      while (end < text_.size() && is_name(text_[end])) ++end;
      return take(Token::Kind::name, end - at_);
    }
    const auto match = std::find_if(kLongSymbols.begin(), kLongSymbols.end(), [&](std::string_view symbol) {
      return text_.compare(at_, symbol.size(), symbol) == 0;
    });
    return take(Token::Kind::symbol, match == kLongSymbols.end() ? 1 : match->size());
  }

  Token take(Token::Kind kind, std::size_t length) {
    Token token{kind, text_.substr(at_, length), std::move(before_), file_, line_};
    before_.clear();
    at_ += length;
    return token;
  }

  void directive() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string line = text_.substr(at_, end - at_);
    at_ = end;
    while (is_white_space(line.back())) line.pop_back();
    const std::size_t start = std::min(line.find_first_not_of("# \t"), line.size());
    const auto is = [&](std::string_view word) { return line.compare(start, word.size(), word) == 0; };
    if (is("version")) return;
    if (is("extension")) {
      // Our own, for #line with file names: no driver needs it.
      if (line.find("GL_GOOGLE_cpp_style_line_directive") == std::string::npos) list_.extensions.push_back(line);
      return;
    }
    before_ += is("line") ? numbered(line) : line;
  }

  // Takes over the position of #line N ["file"]: the next line is line N.
  std::string numbered(const std::string& line) {
    std::size_t at = line.find_first_of("0123456789");
    if (at == std::string::npos) return line;
    int number = 0;
    for (; at < line.size() && is_digit(line[at]); ++at) number = number * 10 + (line[at] - '0');
    line_ = number - 1;
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (close != open) {
      const std::string name = line.substr(open + 1, close - open - 1);
      const auto known = std::find(list_.files.begin(), list_.files.end(), name);
      file_ = int(known - list_.files.begin());
      if (known == list_.files.end()) list_.files.push_back(name);
    }
    return "#line " + std::to_string(number) + " " + std::to_string(file_);
  }

  const std::string& text_;
  TokenList list_;
  std::size_t at_ = 0;
  int file_ = 0, line_ = 1;
  std::string before_;
};

}  // namespace

TokenList tokenize(const ShaderSource& source, const std::string& preprocessed) {
  return Tokenizer(source, preprocessed).run();
}

TokenList tokenize(const ShaderSource& source) { return tokenize(source, preprocess(source)); }

std::string join(const TokenList& list) {
  std::string result;
  for (const Token& token : list.tokens) {
    result += token.before;
    result += token.text;
  }
  return result + list.end.before;
}

std::string position(const ShaderSource& source, const Token& token) {
  const std::size_t file = std::size_t(token.file) < source.files.size() ? std::size_t(token.file) : 0;
  return (source.files.empty() ? source.name : source.files[file]) + ":" + std::to_string(token.line) + ": ";
}

}  // namespace twinshade
