// Splits GLSL at global scope: Khronos, The OpenGL Shading Language 4.50, section 9 (grammar), external_declaration.
// Only as much of the grammar as tells declarations apart; what is wrong inside one is left to the compiler.
#include "raster/gl/declaration.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "cpu_shaders/source/preprocess.h"
#include "raster/gl/author_names.h"

namespace twinshade::gl {
namespace {

constexpr std::array<std::string_view, 29> kQualifiers = {"in",
                                                          "out",
                                                          "inout",
                                                          "uniform",
                                                          "buffer",
                                                          "const",
                                                          "flat",
                                                          "smooth",
                                                          "noperspective",
                                                          "centroid",
                                                          "sample",
                                                          "patch",
                                                          "precise",
                                                          "highp",
                                                          "mediump",
                                                          "lowp",
                                                          "invariant",
                                                          "coherent",
                                                          "volatile",
                                                          "restrict",
                                                          "readonly",
                                                          "writeonly",
                                                          "shared",
                                                          "varying",
                                                          "attribute",
                                                          "subroutine",
                                                          "superp",
                                                          "bindless_sampler",
                                                          "bindless_image"};

bool is_qualifier(const Token& token) {
  return std::find(kQualifiers.begin(), kQualifiers.end(), token.text) != kQualifiers.end();
}

class Splitter {
 public:
  Splitter(const ShaderSource& source, const std::vector<Token>& tokens) : source_(source), tokens_(tokens) {}

  std::vector<Declaration> run() {
    std::vector<Declaration> result;
    while (at_ < tokens_.size()) result.push_back(declaration());
    return result;
  }

 private:
  using Range = std::pair<std::size_t, std::size_t>;

  bool is(const char* text) const { return at_ < tokens_.size() && tokens_[at_].text == text; }
  bool at_word() const { return at_ < tokens_.size() && tokens_[at_].kind == Token::Kind::name; }

  [[noreturn]] void fail(std::size_t token, const std::string& what) const {
    throw UserError(position(source_, tokens_[std::min(token, tokens_.size() - 1)]) + what);
  }

  // From an opening bracket to behind the one that closes it.
  void skip_bracketed() {
    const std::size_t open = at_;
    std::vector<char> closing;
    do {
      const std::string& text = tokens_[at_].text;
      if (text == "(") closing.push_back(')');
      if (text == "[") closing.push_back(']');
      if (text == "{") closing.push_back('}');
      if (text == ")" || text == "]" || text == "}") {
        if (closing.back() != text[0]) fail(at_, "\"" + text + "\" where \"" + closing.back() + "\" is expected");
        closing.pop_back();
      }
      ++at_;
    } while (!closing.empty() && at_ < tokens_.size());
    if (!closing.empty()) fail(open, "\"" + tokens_[open].text + "\" is never closed");
  }

  void skip_to_semicolon() {
    const std::size_t start = at_;
    while (at_ < tokens_.size() && !is(";")) {
      if (is("(") || is("[") || is("{"))
        skip_bracketed();
      else
        ++at_;
    }
    if (at_ == tokens_.size()) fail(start, "no \";\" behind this declaration");
    ++at_;
  }

  std::vector<Range> arrays() {
    std::vector<Range> result;
    while (is("[")) {
      const std::size_t open = at_;
      skip_bracketed();
      result.emplace_back(open + 1, at_ - 1);
    }
    return result;
  }

  void qualifiers(Declaration& d) {
    while (at_word()) {
      if (is("layout")) {
        const std::size_t start = at_++;
        if (is("(")) skip_bracketed();
        d.layouts.emplace_back(start, at_);
      } else if (is_qualifier(tokens_[at_])) {
        d.qualifiers.push_back(at_++);
      } else {
        break;
      }
    }
  }

  Declaration declaration() {
    Declaration d;
    d.begin = at_;
    if (is(";")) {
      ++at_;
    } else if (is("precision")) {
      d.kind = Declaration::Kind::precision;
      skip_to_semicolon();
    } else {
      qualifiers(d);
      if (is(";")) {
        d.kind = Declaration::Kind::qualifiers_only;
        ++at_;
      } else {
        typed(d);
      }
    }
    d.end = at_;
    return d;
  }

  void typed(Declaration& d) {
    if (!at_word()) {  // not GLSL: the compiler will say why
      skip_to_semicolon();
      return;
    }
    d.type = at_;
    if (is("struct")) {
      ++at_;
      if (at_word()) ++at_;
      if (is("{")) skip_bracketed();
      d.inline_struct = true;
    } else {
      ++at_;
      if (is("{")) {
        d.kind = Declaration::Kind::block;
        skip_to_semicolon();
        return;
      }
    }
    d.type_arrays = arrays();
    // "precise color;" names a variable declared before.
    if (is(";") || is(",")) {
      d.kind = d.inline_struct ? Declaration::Kind::structure : Declaration::Kind::qualifiers_only;
      skip_to_semicolon();
      return;
    }
    if (at_word() && at_ + 1 < tokens_.size() && tokens_[at_ + 1].text == "(") {
      d.kind = Declaration::Kind::function;
      ++at_;
      skip_bracketed();
      if (is("{"))
        skip_bracketed();
      else
        skip_to_semicolon();
      return;
    }
    d.kind = Declaration::Kind::variables;
    variables(d);
  }

  void variables(Declaration& d) {
    for (;;) {
      if (!at_word()) {
        skip_to_semicolon();
        return;
      }
      Declarator item;
      item.name = at_++;
      item.arrays = arrays();
      if (is("=")) item.equals = at_;
      while (at_ < tokens_.size() && !is(",") && !is(";")) {
        if (is("(") || is("[") || is("{"))
          skip_bracketed();
        else
          ++at_;
      }
      if (at_ == tokens_.size()) fail(item.name, "no \";\" behind the declaration of " + tokens_[item.name].text);
      item.end = at_++;
      d.declarators.push_back(item);
      if (tokens_[item.end].text == ";") return;
    }
  }

  const ShaderSource& source_;
  const std::vector<Token>& tokens_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Declaration> split_declarations(const ShaderSource& source, const std::vector<Token>& tokens) {
  return Splitter(source, tokens).run();
}

std::vector<std::string> initialized_uniforms(const ShaderSource& source) {
  std::vector<Token> tokens = tokenize(source).tokens;
  rename_new_words(source, tokens);
  std::vector<std::string> names;
  for (const Declaration& d : split_declarations(source, tokens)) {
    if (d.kind != Declaration::Kind::variables ||
        std::none_of(d.qualifiers.begin(), d.qualifiers.end(), [&](auto q) { return tokens[q].text == "uniform"; }))
      continue;
    for (const Declarator& item : d.declarators)
      if (item.equals) names.push_back(author_name(tokens[item.name].text));
  }
  return names;
}

}  // namespace twinshade::gl
