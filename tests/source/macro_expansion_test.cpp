// What macros become is told before anything is expanded, and never too small.
#include "cpu_shaders/source/macro_expansion.h"

#include <doctest/doctest.h>

#include "cpu_shaders/source/glslang_trial.h"

namespace twinshade {
namespace {

double tokens(const std::string& text) { return estimate_macros(text).tokens; }

// Each macro made of ten of the one before.
std::string tower(int storeys) {
  std::string text = "#define M0 x + x + x + x + x + x + x + x + x + x +\n";
  for (int k = 1; k < storeys; ++k) {
    text += "# define M" + std::to_string(k);
    for (int i = 0; i < 10; ++i) text += " M" + std::to_string(k - 1);
    text += "\n";
  }
  return text + "float y = M" + std::to_string(storeys - 1) + " 0.0;\n";
}

}  // namespace

TEST_CASE("macros within macros and within their own arguments multiply") {
  CHECK(tokens("#define PI 3\nfloat x = PI * PI;\n") == 2);
  CHECK(tokens(tower(1)) == 20);
  CHECK(tokens(tower(7)) == 20e6);
  const std::string twice = "#define A(v) v + v\n";
  CHECK(tokens(twice + "float x = A(1);\n") >= 3);
  CHECK(tokens(twice + "float x = A(A(A(A(1))));\n") >= 31);
  CHECK(tokens(twice + "#define B(v) A(A(v))\nfloat x = B(B(1));\n") >= 31);
  CHECK(tokens("#if 1\n#define A 1\n#else\n#define A 1 + 1 + 1\n#endif\nint x = A;\n") == 5);
}

TEST_CASE("where the size cannot be told, that is told") {
  const auto unclear = [](const std::string& text) { return estimate_macros(text).unclear; };
  const std::string twice = "#define A(v) v + v\n";
  CHECK_FALSE(unclear(twice + "#ifdef A\nfloat x = A\n(1) /* A */; // A\n#endif\n#if defined(A)\n#endif\n"));
  CHECK(unclear(twice + "#define B A\nfloat x = B(B(1));\n"));
  CHECK(unclear(twice + "#define B(f, x) f(f(x))\nfloat x = B(A, 1);\n"));
  CHECK(unclear("#define JOIN(a, b) a##b\nfloat x = JOIN(1, 2);\n"));
  CHECK(unclear("#define A B B\n#define B A A\nfloat x = A;\n"));
  CHECK(tokens("#def\\\nine A(v) v + v\n#if A(A(A(1)))\n#endif\n") >= 15);
  CHECK(tokens(twice + "float x = A(A(A(1 /* ) */)));\n") >= 15);
}

TEST_CASE("a short shader that becomes a large one is tried in a child process, everyday macros are not") {
  const auto hostile = [](const std::string& text) { return looks_hostile(resolve_shader("t", text, "t.frag")); };
  CHECK(hostile(tower(4)));
  CHECK_FALSE(hostile(tower(2)));
  std::string nested = "1.0";
  for (int k = 0; k < 5; ++k) nested = "A(" + nested + ")";
  CHECK(hostile("#define A(v) v * v * v * v * v * v * v\nfloat x = " + nested + ";\n"));
  CHECK_FALSE(
      hostile("#define saturate(x) clamp(x, 0.0, 1.0)\n#define PI 3.14159274\n"
              "void main() { float y = saturate(saturate(PI) * PI); }\n"));
}

}  // namespace twinshade
