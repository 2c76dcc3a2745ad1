// Preprocessed GLSL as tokens: macros expanded, conditionals decided, every token with its file and line. Putting the
// tokens back together gives the same lines again, so that a driver's messages still point into the author's files.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade::gl {

enum class TokenKind { word, number, punctuation };

struct Token {
  TokenKind kind;
  std::string text;
  std::string before;  // white space, line ends and directives between the previous token and this one
  int file = 0;        // index into ShaderSource::files
  int line = 0;
};

struct TokenText {
  std::vector<Token> tokens;
  std::string after;                    // white space and directives behind the last token
  std::vector<std::string> extensions;  // the #extension lines, taken out of the text
};

// `preprocessed` may hold #version (dropped), #extension (collected), #line N "file" (written as #line N k, k an index
// into source.files) and #pragma (kept).
TokenText tokenize(const ShaderSource& source, const std::string& preprocessed);

std::string join(const TokenText& text);

// "file:line: " of a token.
std::string position(const ShaderSource& source, const Token& token);

}  // namespace twinshade::gl
