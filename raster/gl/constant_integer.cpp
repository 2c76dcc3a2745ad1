// Recursive descent over sum, product and primary.
#include "raster/gl/constant_integer.h"

#include <cstdlib>

namespace twinshade::gl {
namespace {

class Evaluator {
 public:
  Evaluator(const std::vector<Token>& tokens, std::size_t begin, std::size_t end,
            const std::map<std::string, long>& constants)
      : tokens_(tokens), at_(begin), end_(end), constants_(constants) {}

  std::optional<long> run() {
    const long value = sum();
    if (failed_ || at_ != end_) return std::nullopt;
    return value;
  }

 private:
  bool take(const char* text) {
    if (at_ >= end_ || tokens_[at_].text != text) return false;
    ++at_;
    return true;
  }

  long sum() {
    long value = product();
    for (;;) {
      if (take("+"))
        value += product();
      else if (take("-"))
        value -= product();
      else
        return value;
    }
  }

  long product() {
    long value = primary();
    for (;;) {
      const bool times = take("*");
      const bool over = !times && take("/");
      const bool remainder = !times && !over && take("%");
      if (!times && !over && !remainder) return value;
      const long right = primary();
      if (!times && right == 0)
        failed_ = true;
      else
        value = times ? value * right : over ? value / right : value % right;
    }
  }

  long primary() {
    if (take("-")) return -primary();
    if (take("(")) {
      const long value = sum();
      failed_ |= !take(")");
      return value;
    }
    if (at_ < end_ && tokens_[at_].kind == Token::Kind::number) {
      char* rest = nullptr;
      const std::string& text = tokens_[at_].text;
      const long value = std::strtol(text.c_str(), &rest, 0);
      const std::string suffix = rest;
      if (suffix.empty() || suffix == "u" || suffix == "U") {
        ++at_;
        return value;
      }
    } else if (at_ < end_) {
      const auto found = constants_.find(tokens_[at_].text);
      if (found != constants_.end()) {
        ++at_;
        return found->second;
      }
    }
    failed_ = true;
    return 0;
  }

  const std::vector<Token>& tokens_;
  std::size_t at_, end_;
  const std::map<std::string, long>& constants_;
  bool failed_ = false;
};

}  // namespace

std::optional<long> constant_integer(const std::vector<Token>& tokens, std::size_t begin, std::size_t end,
                                     const std::map<std::string, long>& constants) {
  return Evaluator(tokens, begin, end, constants).run();
}

}  // namespace twinshade::gl
