// Which lines may be in half: shaders whose lines are known to stand it or not.
#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "base/error.h"
#include "check/half_lines.h"
#include "tests/evaluate/tables.h"

using namespace twinshade;
using test::floats;
using test::fragment;

namespace {

constexpr EvaluationTarget kCpu{Backend::cpu, Number::lanes4, {}};

struct Found {
  HalfLines lines;
  std::map<int, HalfLine> at;
};

Found found_in(const std::string& text, const ValueTable& table, const Tolerance& tolerance) {
  Evaluator evaluator;
  const ShaderSource shader = fragment(text);
  Found found;
  found.lines = find_half_lines(evaluator, shader, cases_of_float(evaluator, shader, table, kCpu, tolerance), kCpu, "");
  for (const HalfLine& line : found.lines.lines) found.at[line.line] = line;
  return found;
}

}  // namespace

TEST_CASE("a line that halves cannot hold is told from one that they can, by how far off it is") {
  // Coordinates from 2048 on have no fraction in half; 70000 is none at all.
  const Found found = found_in(
      "in float x; out vec3 c;\n"
      "void main() {\n"
      "  float cell = fract(x * 1024.0);\n"
      "  float tint = x * 0.25;\n"
      "  float large = x * 35000.0;\n"
      "  int n = 3;\n"
      "  c = vec3(cell, tint, large / 70000.0);\n}\n",
      {2, {floats("x", "float", {2.0001f, 3.70031f})}, {}, {}, {}}, {0, 0.002, 0});
  REQUIRE(found.at.size() == 4);
  CHECK_FALSE(found.at.contains(6));
  const double cell = 3.70031f * 1024 - 3789;
  CHECK(found.at.at(3).alone.off == doctest::Approx(cell / 0.002).epsilon(0.01));
  CHECK_FALSE(found.at.at(3).together);
  CHECK(found.at.at(4).alone.off < 1);
  CHECK(found.at.at(4).together);
  CHECK(found.at.at(5).alone.off == HUGE_VAL);
  CHECK_FALSE(found.at.at(5).together);
  CHECK(found.lines.all.off == HUGE_VAL);
  CHECK(found.lines.together.off <= 1);
  CHECK(found.lines.rows == 2);
  CHECK(found.lines.left_out == 0);
}

TEST_CASE("lines that pass by themselves but not together are chosen from the least harmful on") {
  // Each step rounds 0.1 x to the nearest half: 2^-15 off at most from 0.0625 on. Three of them are too many.
  const std::string text =
      "in float x; out float y;\n"
      "void main() {\n"
      "  float a = x * 0.7;\n"
      "  float b = x * 0.7;\n"
      "  float c = x * 0.7;\n"
      "  y = a + b + c;\n}\n";
  const ValueTable table{1, {floats("x", "float", {0.1001f})}, {}, {}, {}};
  const double exact = double(0.1001f) * double(0.7f), step = std::ldexp(1.0, -14);
  const auto half = [&](double v) { return std::nearbyint(v / step) * step; };
  CHECK(half(exact) != exact);
  const Found one = found_in(text, table, {0, 1, 0});
  const double off = one.at.at(3).alone.off;
  CHECK(off > 0);
  CHECK(one.at.at(4).alone.off == off);
  const Found found = found_in(text, table, {0, off * 2.2, 0});
  CHECK(found.at.at(5).alone.off < 1);
  int chosen = 0;
  for (const auto& [line, at] : found.at) chosen += at.together && line < 6;
  CHECK(chosen == 2);
  CHECK(found.at.at(3).together);
  CHECK(found.at.at(4).together);
  CHECK_FALSE(found.at.at(5).together);
}

TEST_CASE("rows without a finite value in float are left out; one that is discarded in half alone is not") {
  const ValueTable table{3, {floats("x", "float", {0, 1, 1.0001f})}, {}, {}, {}};
  const Found divides = found_in("in float x; out float y;\nvoid main() {\n  y = 1.0 / x;\n}\n", table, {0, 0.01, 0});
  CHECK(divides.lines.left_out == 1);
  CHECK(divides.at.at(3).together);
  const Found discards =
      found_in("in float x; out float y;\nvoid main() {\n  if (x == 1.0) discard;\n  y = x;\n}\n", table, {0, 0.01, 0});
  CHECK(discards.at.at(3).alone.off == HUGE_VAL);
  CHECK(discards.at.at(4).together);
}

TEST_CASE("what float gives no number for is left out by component, and named where that is always") {
  const ValueTable table{2, {floats("x", "float", {0.7001f, 0.9f})}, {}, {}, {}};
  const Found found = found_in(
      "in float x; out vec3 y; out vec2 z;\nvoid main() {\n  float b = x * 1000.0;\n"
      "  y = vec3(b, 0.0, sqrt(x - 2.0));\n  z = vec2(log(x - 0.8), x);\n}\n",
      table, {0, 0.01, 0});
  CHECK(found.at.at(3).alone.off > 1);
  REQUIRE(found.at.at(3).alone.worst.has_value());
  CHECK(found.at.at(3).alone.worst->component == 0);
  CHECK(found.lines.unjudged == std::vector<std::string>{"y.z"});
  CHECK(found.lines.left_out == 0);
  CHECK_THROWS_WITH_AS(found_in("in float x; out float y;\nvoid main() { y = sqrt(x - 2.0); }\n", table, {0, 0.01, 0}),
                       doctest::Contains("test.frag: there is no value to judge by"), UserError);
  CHECK_THROWS_AS(found_in("in float x; out float y;\nvoid main() { y = x; discard; }\n", table, {0, 0.01, 0}),
                  UserError);
}

TEST_CASE("a loop that ends in float alone is a finding, not an error") {
  // From 2048 on x + 1 is x.
  const Found found = found_in(
      "in float x; out float y;\nvoid main() {\n  y = x;\n  for (float i = 0.0; i < 3000.0; i += x) y += 0.001;\n}\n",
      {1, {floats("x", "float", {1})}, {}, {}, {}}, {0, 0.01, 0});
  CHECK(found.at.at(4).alone.off == HUGE_VAL);
  CHECK(found.at.at(4).alone.other == "does not end");
  CHECK(found.at.at(3).together);
}

TEST_CASE("of ES as its qualifiers have it is told, too") {
  const std::string body = "in float x; out float y;\nvoid main() {\n  y = fract(x * 1024.0);\n}\n";
  const ValueTable table{1, {floats("x", "float", {3.70031f})}, {}, {}, {}};
  const Found narrow = found_in("#version 300 es\nprecision mediump float;\n" + body, table, {0, 0.01, 0});
  REQUIRE(narrow.lines.declared.has_value());
  CHECK(narrow.lines.declared->off > 1);
  CHECK(found_in("#version 300 es\nprecision highp float;\n" + body, table, {0, 0.01, 0}).lines.declared->off == 0);
  CHECK_FALSE(found_in(body, table, {0, 0.01, 0}).lines.declared.has_value());
}

TEST_CASE("cases that float itself fails are refused, and a shader without floats has no lines") {
  Evaluator evaluator;
  const ShaderSource shader = fragment("in float x; out float y;\nvoid main() { y = x; }\n");
  Cases cases{{1, {floats("x", "float", {1})}, {}, {}, {}}, {{floats("y", "float", {2}), {1}}}, {0, 0.5, 0}};
  CHECK_THROWS_WITH_AS(find_half_lines(evaluator, shader, cases, kCpu, "my.json"),
                       doctest::Contains("my.json: row 0 is beyond the tolerance in float"), UserError);
  const Found none = found_in("flat in int i; out int y;\nvoid main() { y = i; }\n",
                              {1, {test::ints("i", "int", {1})}, {}, {}, {}}, {0, 0.5, 0});
  CHECK(none.at.empty());
  CHECK(none.lines.together.off == 0);
}
