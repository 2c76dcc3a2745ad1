// Shaders in mediump and half, against expected values worked out by hand and the same arithmetic done anew.
#include <doctest/doctest.h>

#include <cmath>

#include "cpu_shaders/translate/translate.h"
#include "tests/evaluate/tables.h"

using namespace twinshade;
using test::floats;
using test::fragment;

namespace {

ShaderSource in_precision(const std::string& text, Precision precision) {
  ShaderSource source = fragment(text);
  source.precision = precision;
  return source;
}

// The same values from lanes of every width.
std::vector<double> values_of(const ShaderSource& shader, const ValueTable& table, const std::string& output) {
  std::vector<double> first;
  std::vector<std::string> as_first;
  Evaluator evaluator;
  for (const Number number : {Number::lanes4, Number::scalar}) {
    const EvaluatedRows rows = evaluator.run(shader, table, {Backend::cpu, number, {}});
    if (as_first.empty()) as_first = test::listing(rows);
    CHECK(test::listing(rows) == as_first);
    const Values& values = *find_values(rows.outputs, output);
    first.clear();
    const std::size_t components = values.bits.size() / table.rows;
    for (std::size_t row = 0; row < table.rows; ++row)
      for (std::uint32_t c = 0; c < components; ++c) first.push_back(value_at(values, row, c));
  }
  return first;
}

// Ten fractional digits from the leading one on; for numbers that are no denormal halves.
float half(double x) {
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  return float(std::ldexp(std::nearbyint(mantissa * 2048), exponent - 11));
}

const std::string kMobile =
    "#version 310 es\nprecision mediump float;\nin vec3 n;\nin highp float x;\n"
    "layout(location = 0) out vec3 unit; layout(location = 1) out highp vec3 sums;\n"
    "void main() {\n"
    "  unit = normalize(n);\n"
    "  float narrow = 0.0;\n  highp float wide = 0.0;\n"
    "  for (int i = 0; i < 255; ++i) { narrow += 0.00392156886; wide += 0.00392156886; }\n"
    "  float moved = x * 1024.0;\n"
    "  sums = vec3(narrow, wide, x * 1024.0 - moved);\n"
    "}\n";

// By line, with every one of the lines in half or none.
std::vector<std::string> by_line(Evaluator& evaluator, const std::string& text, ValueTable table, bool half) {
  const ShaderSource shader = in_precision(text, Precision::by_line);
  const std::size_t lines = evaluator.reflection(shader).half_lines.size();
  REQUIRE(lines > 0);
  table.uniforms.push_back({kHalfLines, {Scalar::u32, 1, 1, std::uint32_t(lines)}, {}, {}});
  table.uniforms.back().bits.assign(lines, half);
  return test::listing(evaluator.run(shader, table, {Backend::cpu, Number::lanes4, {}}));
}

}  // namespace

TEST_CASE("mediump fails as GPUs do: lengths overflow, sums stall, coordinates lose their fraction") {
  const ValueTable table{
      2, {floats("n", "vec3", {0, 0.6f, 0.8f, 0, 180, 240}), floats("x", "float", {0.7f, 3.7f})}, {}, {}, {}};
  const ShaderSource narrow = in_precision(kMobile, Precision::mediump), wide = in_precision(kMobile, Precision::full);
  CHECK(values_of(wide, table, "unit")[4] == doctest::Approx(0.6));
  const std::vector<double> unit = values_of(narrow, table, "unit"), sums = values_of(narrow, table, "sums");
  CHECK(unit[1] == doctest::Approx(0.6).epsilon(2e-3));
  CHECK(unit[1] != doctest::Approx(0.6).epsilon(1e-5));
  CHECK(unit[4] == 0);  // 180^2 + 240^2 is infinite
  float sum = 0;
  for (int i = 0; i < 255; ++i) sum = half(double(sum) + half(1 / 255.0));
  CHECK(sums[0] == sum);
  CHECK(std::fabs(sums[0] - 1) > 1e-3);
  CHECK(sums[1] == doctest::Approx(1).epsilon(1e-5));
  CHECK(sums[5] == double(3.7f * 1024) - half(3.7f * 1024));
  CHECK(std::fabs(sums[5]) > 0.5);  // of a texel
}

TEST_CASE("a shader without precision qualifiers gives the same bits in mediump") {
  const std::string text =
      "in vec3 n; out vec4 c;\nvoid main() { c = vec4(normalize(n), sin(n.x) * 0.1 + dot(n, n.zxy)); }\n";
  const ValueTable table{2, {floats("n", "vec3", {1, 0.6f, 0.8f, 3, 180, 240})}, {}, {}, {}};
  CHECK(values_of(in_precision(text, Precision::mediump), table, "c") ==
        values_of(in_precision(text, Precision::full), table, "c"));
}

TEST_CASE("in half each operation is rounded, and functions of shaders/exact/ once") {
  const std::string text =
      "#include \"exact/sin_cos.glsl\"\n#include \"exact/dot.glsl\"\nin vec3 v;\n"
      "layout(location = 0) out vec4 c; layout(location = 1) out int i;\n"
      "void main() {\n"
      "  mat2 m = mat2(v.xy, v.yz);\n"
      "  vec2 t = m * v.zx;\n"
      "  float list[3] = float[3](v.x, v.y, 0.1);\n"
      "  c = vec4((v.x * v.y + v.z) / 3.0, t.y, exact_sin(v.x) - list[int(v.x * 2.0)], exact_dot(v, v.zxy));\n"
      "  i = int(v.y);\n}\n";
  const std::vector<float> v = {0.3f, 1.7f, 0.123f, 1.1f, 2.2f, 3.3f};
  const ValueTable table{2, {floats("v", "vec3", v)}, {}, {}, {}};
  const std::vector<double> c = values_of(in_precision(text, Precision::half), table, "c");
  for (std::size_t row = 0; row < 2; ++row) {
    const float x = half(v[3 * row]), y = half(v[3 * row + 1]), z = half(v[3 * row + 2]);
    CHECK(c[4 * row] == half(half(half(x * y) + z) / 3.0));
    CHECK(c[4 * row + 1] == half(half(y * z) + half(z * x)));
    const float picked[] = {x, y, half(0.1)};
    CHECK(c[4 * row + 2] == half(half(std::sin(double(x))) - picked[int(x * 2)]));
    CHECK(c[4 * row + 3] == half(half(half(x * z) + half(y * x)) + half(z * y)));
  }
}

// What glslang leaves undecorated, components of inputs and members of structs among it, is found all the same.
TEST_CASE("a shader that is mediump throughout gives the same bits in mediump and in half") {
  const std::string text = R"(#version 310 es
precision mediump float;
precision mediump int;
struct Light { vec3 dir; float power[2]; mat2 turn; };
uniform Light light;
uniform Block { vec4 tint; float gains[3]; };
in vec3 n; in vec2 uv; flat in int k;
layout(location = 0) out vec4 c; layout(location = 1) out vec4 d;
vec3 kept = vec3(0.1, 0.2, 0.3);
const float weights[3] = float[3](0.1, 0.7, 0.2);
float shade(in Light l, vec3 m, out float spec, inout vec3 sum) {
  float lambert = max(dot(l.dir, m), 0.0);
  spec = pow(lambert, 7.3) * l.power[1];
  sum += lambert * l.power[0] * vec3(1.0, 0.9, 0.7);
  if (lambert < 0.3) return lambert / 3.0;
  return sqrt(lambert) + kept.y;
}
void main() {
  vec3 m = normalize(n), sum = vec3(0.0);
  float s, list[3];
  for (int i = 0; i < 3; ++i) list[i] = weights[i] * gains[i] + uv.x * float(i);
  float r = shade(light, m, s, sum);
  kept += r * s;
  list[k] -= r;
  for (float x = 0.0; x < 1.0; x += 0.07) { if (x > uv.y) break; sum.z += x * list[(k + 1) % 3]; }
  vec2 t = light.turn * uv * 37.1, w;
  w.yx = fract(t);
  bool flip = all(lessThan(w, vec2(0.7))) ^^ (t.x < 0.31);
  c = vec4(sum, s) * tint;
  c.w = flip ? w.x : 0.77;
  d = vec4(reflect(m, kept), mix(list[0], list[2], 0.3)) + vec4(list[k], w, 1.0 / (0.1 + uv.y));
})";
  ValueTable table{24, {}, {}, {}, {}};
  std::vector<float> n, uv;
  std::vector<std::int64_t> k;
  for (int row = 0; row < 24; ++row) {
    for (int i = 0; i < 3; ++i) n.push_back(float(std::sin(1.7 * row + i)) * 2);
    for (int i = 0; i < 2; ++i) uv.push_back(float(std::fabs(std::sin(2.3 * row + i))));
    k.push_back(row % 3);
  }
  table.inputs = {floats("n", "vec3", n), floats("uv", "vec2", uv), test::ints("k", "int", k)};
  table.uniforms = {floats("light.dir", "vec3", {0.3f, 0.5f, 0.81f}), floats("light.power", "float[2]", {0.7f, 0.45f}),
                    floats("light.turn", "mat2", {0.6f, 0.8f, -0.8f, 0.6f}),
                    floats("tint", "vec4", {0.9f, 0.8f, 0.7f, 0.6f}), floats("gains", "float[3]", {0.3f, 0.2f, 0.1f})};
  Evaluator evaluator;
  const auto listed = [&](Precision precision) {
    return test::listing(evaluator.run(in_precision(text, precision), table, {Backend::cpu, Number::lanes4, {}}));
  };
  const std::vector<std::string> narrow = listed(Precision::mediump);
  CHECK(narrow == listed(Precision::half));
  CHECK(narrow != listed(Precision::full));
  CHECK(by_line(evaluator, text, table, true) == narrow);
  CHECK(by_line(evaluator, text, table, false) == listed(Precision::full));
}

TEST_CASE("with every line in half a shader gives the bits of half, with none those of float") {
  const std::string text =
      "#include \"exact/sin_cos.glsl\"\n#include \"exact/dot.glsl\"\nin vec3 half_lines;\n"
      "out vec4 c;\nuniform float first[2];\n"
      "float of_halves(float x) { return x; }\n"
      "float half_here(float x) { return x; }\n"
      "void main() {\n"
      "  c = vec4(0.1, exact_sin(half_lines.x), exact_dot(half_lines, half_lines.zxy), first[1]);\n"
      "  c.x += of_halves(half_here(0.3)) * -half_lines.x;\n"
      "  if (half_lines.y > 1.7001) c.w = dFdx(half_lines.z);\n}\n";
  const ValueTable table{4,
                         {floats("half_lines", "vec3", {0.3f, 1.7f, 0.123f, 1.1f, 2.2f, 3.3f, 7, 8, 9.3f, 0, 0, 0.1f})},
                         {floats("first", "float[2]", {0.1f, 0.7f})},
                         {},
                         {}};
  Evaluator evaluator;
  for (const Precision whole : {Precision::full, Precision::half})
    CHECK(by_line(evaluator, text, table, whole == Precision::half) ==
          test::listing(evaluator.run(in_precision(text, whole), table, {Backend::cpu, Number::lanes4, {}})));
}
