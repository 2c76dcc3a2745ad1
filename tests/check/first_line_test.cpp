// The first line that differs, between the CPU flushing denormals and the CPU keeping them: a.x * a.y * a.z is 0 or
// 2^-40.
#include <doctest/doctest.h>

#include <bit>
#include <string>

#include "check/first_line.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {
namespace {

FirstLine first_line_of(const std::string& text) {
  static Evaluator evaluator;
  Values a;
  a.name = "a";
  a.type.rows = 3;
  for (const float value : {0x1p-100f, 0x1p-40f, 0x1p100f}) a.bits.push_back(std::bit_cast<std::uint32_t>(value));
  ValueTable table;
  table.rows = 1;
  table.inputs = {a};
  EvaluationTarget flushes, keeps;
  keeps.keep_denormals = true;
  return first_differing_line(evaluator, resolve_shader("t", "in vec3 a; out vec4 c;\n" + text, "t.frag"), table, 0,
                              flushes, keeps);
}

void check_first(const std::string& text, int line, const std::string& what, std::size_t occurrence = 1) {
  CAPTURE(text);
  const FirstLine found = first_line_of(text);
  CAPTURE(found.note);
  REQUIRE(found.difference.has_value());
  CHECK(found.difference->statement.line == line);
  CHECK(found.difference->statement.what == what);
  CHECK(found.difference->occurrence == occurrence);
}

}  // namespace

TEST_CASE("a global that differs is named at its own line, behind functions and in front of them") {
  check_first(
      "float f(float x) { return x; }\nfloat g = a.x * a.y * a.z;\n"
      "void h(inout float k) {\n  float z = a.y;\n  k = z;\n}\nvoid main() { float b = a.z; h(b); c = vec4(b, g, 0, "
      "1); }\n",
      3, "g");
}

TEST_CASE("an argument that differs is named at the line of the call, not within what is called") {
  check_first(
      "float twice(float x) {\n  float y = x * 2.0;\n  return y; }\n"
      "void main() {\n  float r = twice(a.x * a.y * a.z);\n  c = vec4(r); }\n",
      6, "argument 1 of twice");
}

TEST_CASE("executions are counted, not values; members, columns and elements are named") {
  check_first(
      "void main() {\n  for (float f = 0.0; f < 4.0; f += 1.0)\n    c = vec4(f > 1.5 ? a.x * a.y * a.z : f);\n}\n", 4,
      "c", 3);
  check_first("void main() {\n  for (float f = 1.0; f > 0.0; f = f * a.x * a.y * a.z) c = vec4(f);\n}\n", 3,
              "condition", 2);
  check_first(
      "struct S { float first; vec2 second; };\nvoid main() {\n  S s = S(a.x, a.yz * (a.x * a.y * a.z));\n"
      "  c = vec4(s.first, s.second, 1.0); }\n",
      4, "s.second");
  check_first("void main() {\n  mat3 P = mat3(a, a, a * (a.x * a.y * a.z));\n  c = vec4(P[2], 1.0); }\n", 3, "P[2]");
  check_first(
      "struct S { float w[2]; };\nS f() {\n  return S(float[2](a.x, a.x * a.y * a.z)); }\n"
      "void main() { c = vec4(f().w[1]); }\n",
      4, "(result of f).w[1]");
  check_first("float[2] f() {\n  return float[2](a.x, a.x * a.y * a.z); }\nvoid main() { c = vec4(f()[1]); }\n", 3,
              "(result of f)[1]");
}

TEST_CASE("what a condition, a selector, a result or an argument stores is named there, not where it is used") {
  const std::string product = "a.x * a.y * a.z";
  check_first("void main() {\n  float t;\n  if ((t = " + product + ") > 1.0) c = a.xyzx;\n  c = vec4(t);\n}\n", 4, "t");
  check_first("void main() {\n  float t;\n  switch (int(t = " + product + ")) { default: }\n  c = vec4(t);\n}\n", 4,
              "t");
  check_first("void main() {\n  float t = 1.0;\n  for (int i = 0; (t *= " + product +
                  ") > -1.0 && i < 3; ++i) ;\n  c = vec4(t);\n}\n",
              4, "t");
  check_first("float g;\nfloat f() {\n  return (g = " + product +
                  ", 1.0); }\nvoid main() {\n  float r = f();\n  c = vec4(r, g, 0, 1); }\n",
              4, "g");
  check_first("float f(float x) { return 1.0; }\nvoid main() {\n  float x = 0.0, y;\n  y = f(x += 1.0);\n  y = f(x = " +
                  product + ");\n  c = vec4(x, y, 0, 1); }\n",
              6, "argument 1 of f");
}

TEST_CASE("what a built-in function writes is named where it is called") {
  check_first(
      "void main() {\n  float whole; float part;\n  part = modf(a.y, whole);\n"
      "  part = 0.0 * modf(a.x * a.y * a.z * 1099511627776.0, whole);\n"
      "  c = vec4(whole);\n}\n",
      5, "whole");
}

TEST_CASE("values keep their type") {
  const FirstLine found = first_line_of(
      "void main() {\n  uint bits = floatBitsToUint(-(a.x * a.y * a.z));\n  c = vec4(uintBitsToFloat(bits)); }\n");
  REQUIRE(found.difference.has_value());
  CHECK(found.difference->scalar == Scalar::u32);
  CHECK(found.difference->b[0] == std::bit_cast<std::uint32_t>(-0x1p-40f));
}

TEST_CASE("a shader of as many outputs as there can be is searched too") {
  std::string declared, stored;
  for (int k = 1; k < 8; ++k) {
    declared += "out vec4 more" + std::to_string(k) + "; ";
    stored += "  more" + std::to_string(k) + " = a.xyzx;\n";
  }
  check_first(declared + "\nvoid main() {\n" + stored + "  c = vec4(a.x * a.y * a.z);\n}\n", 11, "c");
}

TEST_CASE("where no value differs, the note says so, and whether all could be looked at") {
  CHECK(first_line_of("void main() { c = vec4(a, 1.0); }\n").note.find("several statements") != std::string::npos);
  CHECK(first_line_of("int k; int next() { return k++; }\n"
                      "void main() { float w[2]; w[next()] = a.x; c = vec4(w[0]); }\n")
            .note.find("can be looked at") != std::string::npos);
}

}  // namespace twinshade
