// Preprocessed GLSL as tokens that know their author's file and line.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade::lint_detail {

struct Token {
  enum class Kind { name, number, symbol, end };
  Kind kind = Kind::end;
  std::string text;
  int file = 0;  // index into TokenList::files
  int line = 0;
};

struct TokenList {
  std::vector<Token> tokens;  // the last one is Kind::end
  std::vector<std::string> files;
  std::vector<std::string> extensions;  // the #extension lines, which are no tokens
};

// Macros expanded and conditionals resolved by glslang's preprocessor; numbers keep their spelling.
TokenList tokenize(const ShaderSource& source);

}  // namespace twinshade::lint_detail
