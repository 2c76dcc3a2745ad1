// One declaration at global scope, as token indices.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::gl {

struct Declarator {
  std::size_t name = 0;                                     // token
  std::vector<std::pair<std::size_t, std::size_t>> arrays;  // [first, last) tokens between each pair of brackets
  std::optional<std::size_t> equals;                        // token "="
  std::size_t end = 0;                                      // token "," or ";" behind it
};

struct Declaration {
  enum class Kind { variables, block, structure, function, precision, qualifiers_only, empty };
  Kind kind = Kind::empty;
  std::size_t begin = 0, end = 0;                                // tokens [begin, end)
  std::vector<std::size_t> qualifiers;                           // word tokens: in, out, flat, precise ...
  std::vector<std::pair<std::size_t, std::size_t>> layouts;      // tokens from "layout" to behind its ")"
  std::size_t type = 0;                                          // token: type name, or "struct", or block name
  std::vector<std::pair<std::size_t, std::size_t>> type_arrays;  // vec3[2] c
  std::vector<Declarator> declarators;                           // Kind::variables
  bool inline_struct = false;                                    // struct S { ... } a, b;
};

// Splits the whole text. UserError with file and line where braces or brackets do not close (the driver would say so
// too, but less clearly).
std::vector<Declaration> split_declarations(const ShaderSource& source, const std::vector<Token>& tokens);

// Names of the uniforms that the shader gives a value itself: a bundle may leave them out.
std::vector<std::string> initialized_uniforms(const ShaderSource& source);

}  // namespace twinshade::gl
