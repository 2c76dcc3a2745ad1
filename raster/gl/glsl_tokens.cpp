#include "raster/gl/glsl_tokens.h"

#include <algorithm>
#include <cctype>

namespace twinshade::gl {
namespace {

bool is_word_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

class Tokenizer {
 public:
  Tokenizer(const ShaderSource& source, const std::string& text) : source_(source), text_(text) {}

  TokenText run() {
    bool at_line_start = true;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        before_ += c;
        ++at_, ++line_;
        at_line_start = true;
      } else if (std::isspace(static_cast<unsigned char>(c))) {
        before_ += c;
        ++at_;
      } else if (c == '#' && at_line_start) {
        directive();
      } else {
        at_line_start = false;
        token();
      }
    }
    result_.after = std::move(before_);
    return std::move(result_);
  }

 private:
  void directive() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string line = text_.substr(at_, end - at_);
    at_ = end;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (starts_with(line, "#version")) return;
    if (starts_with(line, "#extension")) {
      // Our own, for #line with file names: no driver needs it.
      if (line.find("GL_GOOGLE_cpp_style_line_directive") == std::string::npos) result_.extensions.push_back(line);
      return;
    }
    if (starts_with(line, "#line")) line = numbered(line);
    before_ += line;
  }

  // Takes over the position; the directive counts from the next line on.
  std::string numbered(const std::string& line) {
    std::size_t digits = line.find_first_of("0123456789");
    if (digits == std::string::npos) return line;
    int number = 0;
    for (; digits < line.size() && is_digit(line[digits]); ++digits) number = number * 10 + (line[digits] - '0');
    line_ = number - 1;
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (close != open) {
      const auto found = std::find(source_.files.begin(), source_.files.end(), line.substr(open + 1, close - open - 1));
      file_ = found == source_.files.end() ? 0 : int(found - source_.files.begin());
    }
    return "#line " + std::to_string(number) + " " + std::to_string(file_);
  }

  void token() {
    Token token;
    const std::size_t start = at_;
    if (is_word_start(text_[at_])) {
      token.kind = TokenKind::word;
      while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    } else if (is_digit(text_[at_]) || (text_[at_] == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) {
      token.kind = TokenKind::number;
      while (at_ < text_.size() && (is_word(text_[at_]) || text_[at_] == '.' || is_exponent_sign(start))) ++at_;
    } else {
      token.kind = TokenKind::punctuation;
      ++at_;
    }
    token.text = text_.substr(start, at_ - start);
    token.before = std::move(before_);
    before_.clear();
    token.file = file_;
    token.line = line_;
    result_.tokens.push_back(std::move(token));
  }

  bool is_exponent_sign(std::size_t start) const {
    const bool hexadecimal = start + 1 < text_.size() && text_[start] == '0' && (text_[start + 1] | 32) == 'x';
    return !hexadecimal && at_ > start && (text_[at_] == '+' || text_[at_] == '-') && (text_[at_ - 1] | 32) == 'e';
  }

  const ShaderSource& source_;
  const std::string& text_;
  std::size_t at_ = 0;
  int file_ = 0, line_ = 1;
  std::string before_;
  TokenText result_;
};

}  // namespace

TokenText tokenize(const ShaderSource& source, const std::string& preprocessed) {
  return Tokenizer(source, preprocessed).run();
}

std::string join(const TokenText& text) {
  std::string result;
  for (const Token& token : text.tokens) {
    result += token.before;
    result += token.text;
  }
  return result + text.after;
}

std::string position(const ShaderSource& source, const Token& token) {
  const std::string file = source.files.empty() ? source.name : source.files[std::size_t(token.file)];
  return file + ":" + std::to_string(token.line) + ": ";
}

}  // namespace twinshade::gl
