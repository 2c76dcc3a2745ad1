#include "cpu_shaders/source/glsl_tokens.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cpu_shaders/source/builtin_shaders.h"

using namespace twinshade;

namespace {

std::vector<std::string> texts(const TokenList& list) {
  std::vector<std::string> all;
  for (const Token& token : list.tokens) all.push_back(token.text);
  return all;
}

}  // namespace

TEST_CASE("tokens put together again are the preprocessed text, line for line") {
  const std::string text =
      "#define SUM a += b\nfloat a = 1.0e-5, b = .5e+3f;\n\nvoid main()\n{ SUM - 0x1Fu+a; } // end\n\n";
  const ShaderSource source = resolve_shader("test", text, "test.frag");
  const TokenList list = tokenize(source);
  CHECK(texts(list) ==
        std::vector<std::string>{"float", "a", "=", "1.0e-5", ",", "b", "=",     ".5e+3f", ";", "void", "main", "(",
                                 ")",     "{", "a", "+=",     "b", "-", "0x1Fu", "+",      "a", ";",    "}"});
  for (const Token& token : list.tokens) {
    if (token.text == "main") CHECK(position(source, token) == "test.frag:4: ");
    if (token.text == "0x1Fu") CHECK(token.line == 5);
  }
  const auto is_number = [](const Token& token) { return token.kind == Token::Kind::number; };
  CHECK(std::count_if(list.tokens.begin(), list.tokens.end(), is_number) == 3);
  CHECK(list.end.kind == Token::Kind::end);
  CHECK(list.end.line >= 5);
  CHECK(texts(tokenize(source, join(list))) == texts(list));
}

TEST_CASE("operators are as long as they can be") {
  CHECK(texts(tokenize(ShaderSource(), "a<<=b>>c^^!d!=-e--")) ==
        std::vector<std::string>{"a", "<<=", "b", ">>", "c", "^^", "!", "d", "!=", "-", "e", "--"});
}

TEST_CASE("#line directives give tokens their file, and become numbers for drivers") {
  ShaderSource source;
  source.files = {"a.frag", "b.glsl"};
  const TokenList list = tokenize(source, "#line 7 \"b.glsl\"\nint x;\n#line 3 \"a.frag\"\n\nint y;\n");
  REQUIRE(list.tokens.size() == 6);
  CHECK(position(source, list.tokens[1]) == "b.glsl:7: ");
  CHECK(position(source, list.tokens[4]) == "a.frag:4: ");
  CHECK(join(list) == "#line 7 1\nint x;\n#line 3 0\n\nint y;\n");
}

TEST_CASE("versions are dropped, extensions are collected, pragmas stay") {
  const TokenList list = tokenize(ShaderSource(),
                                  "#version 450\n#extension GL_ARB_x : enable\n"
                                  "#extension GL_GOOGLE_cpp_style_line_directive : require\n#pragma once\nint x;");
  CHECK(list.extensions == std::vector<std::string>{"#extension GL_ARB_x : enable"});
  CHECK(join(list) == "\n\n\n#pragma once\nint x;");
  CHECK(list.tokens.front().line == 5);
}
