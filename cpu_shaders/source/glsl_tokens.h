// Preprocessed GLSL as tokens: macros expanded, conditionals decided, every token with its file and line. Putting the
// tokens back together gives the same lines again, so that a driver's messages still point into the author's files.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct Token {
  enum class Kind { name, number, symbol, end };
  Kind kind = Kind::end;
  std::string text;    // numbers keep their spelling
  std::string before;  // white space, line ends and directives between the previous token and this one
  int file = 0;        // index into TokenList::files
  int line = 0;
};

struct TokenList {
  std::vector<Token> tokens;
  Token end;  // Kind::end: what is behind the last token
  // As ShaderSource::files, or the shader's name alone; then what else #line names. All as #line can have them:
  // with_real_names() gives those back.
  std::vector<std::string> files;
  std::vector<std::string> extensions;  // the #extension lines, taken out of the text
};

// `preprocessed` may hold #version (dropped), #extension (collected), #line N "file" (written as #line N k, k an index
// into files) and #pragma (kept).
TokenList tokenize(const ShaderSource& source, const std::string& preprocessed);
// Of the source's text, preprocessed by glslang.
TokenList tokenize(const ShaderSource& source);

std::string join(const TokenList& list);

// "file:line: " of a token of the source.
std::string position(const ShaderSource& source, const Token& token);

}  // namespace twinshade
