#include "cpu_shaders/translate/constant_initializers.h"

#include <doctest/doctest.h>

#include <string>

#include "base/error.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

std::string refusal_of(const std::string& globals) {
  try {
    translate(
        resolve_shader("t", "#version 450\n" + globals + "out vec4 c;\nvoid main() { c = vec4(x); }\n", "t.frag"));
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("globals lose const where functions that glslang does not fold, or such globals, are in their values") {
  CHECK(with_computed_constants(
            "const int a = 1, b = bitCount(7);\nconst float[2] d = float[2](b, 1);\nconst int e = a;") ==
        "      int a = 1, b = bitCount(7);\n      float[2] d = float[2](b, 1);\n      int e = a;");
  for (const char* text : {"const float a = sin(1.0);", "const int transpose = 1;", "void f(const int x) { }",
                           "void f() { const int n = bitCount(7); }", "// const int n = bitCount(7);"})
    CHECK(with_computed_constants(text) == text);
}

TEST_CASE("constants of built-in functions that glslang does not fold are accepted") {
  for (const char* value :
       {"sinh(0.0)", "acosh(1.0)", "transpose(mat2(1.0, 2.0, 3.0, 4.0))[0][1]", "inverse(mat2(2.0))[0][0]",
        "determinant(mat2(2.0))", "float(bitCount(7))", "fma(2.0, 3.0, 4.0)", "float(mix(1, 2, true))",
        "uintBitsToFloat(0x40000000u)", "float(findMSB(9))", "unpackHalf2x16(0x3c00u).x"}) {
    CAPTURE(value);
    CHECK(refusal_of("const float y = " + std::string(value) + ";\nconst float x = y + 1.0;\n") == "");
  }
}

TEST_CASE("what is no constant in any reading of it is refused as before") {
  const std::string of_input = refusal_of("in float v;\nconst float x = v;\n");
  CHECK_MESSAGE(of_input.find("t.frag:3: ") == 0, of_input);
  const std::string size = refusal_of("const int n = bitCount(7);\nconst float x = 1.0;\nfloat list[n];\n");
  CHECK_MESSAGE(size.find("t.frag:2: '=' : global const initializers must be constant") == 0, size);
}

}  // namespace twinshade
