#include "evaluate/evaluator.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tests/evaluate/tables.h"

using namespace twinshade;
using test::error_of;
using test::floats;
using test::fragment;
using test::ints;

namespace {

// Every backend, softpipe or not as asked, gives the same bits; those of the CPU are returned.
EvaluatedRows same_everywhere(const ShaderSource& shader, const ValueTable& table, bool softpipe = true) {
  Evaluator evaluator;
  EvaluatedRows first;
  for (const EvaluationTarget& target : test::every_target()) {
    if (target.backend == Backend::softpipe && !softpipe) continue;
    const EvaluatedRows rows = evaluator.run(shader, table, target);
    if (first.kept.empty()) first = rows;
    const std::vector<std::string> a = test::listing(first), b = test::listing(rows);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) CHECK_MESSAGE(a[i] == b[i], test::name_of(target));
  }
  return first;
}

}  // namespace

TEST_CASE("inputs of every type arrive as they are, on every backend") {
  const std::string text =
      "in float f; in vec2 f2; noperspective in vec3 f3; in vec4 f4; in mat2x3 m; in vec2 fa[3];\n"
      "flat in int i; flat in ivec3 i3; flat in uint u; flat in uvec2 u2; flat in int ia[2];\n"
      "layout(location = 0) out vec4 a; layout(location = 1) out vec4 b; layout(location = 2) out ivec4 c;\n"
      "layout(location = 3) out uvec3 d; layout(location = 4) out vec3 e[2]; layout(location = 6) out vec2 g;\n"
      "void main() {\n  a = vec4(f, f2, f3.x); b = f4; c = ivec4(i, i3); d = uvec3(u, u2); e[0] = m[0]; e[1] = m[1];\n"
      "  g = fa[1] + vec2(f3.yz) * float(ia[1]) + fa[2] + fa[0];\n}\n";
  ValueTable table{3, {}, {}, {}, {}};
  table.inputs = {floats("f", "float", {-0.0f, INFINITY, 1e-45f * 0 + 3.5f}),
                  floats("f2", "vec2", {1, 2, 3, 4, 5, 6}),
                  floats("f3", "vec3", {1, 2, 3, 4, 5, 6, 7, 8, 9}),
                  floats("f4", "vec4", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}),
                  floats("m", "mat2x3", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}),
                  floats("fa", "vec2[3]", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}),
                  ints("i", "int", {-2147483648, 2147483647, -1}),
                  ints("i3", "ivec3", {1, 2, 3, 4, 5, 6, 7, 8, 9}),
                  ints("u", "uint", {4294967295, 0x7fc00001, 0xff800001}),  // NaNs, were they floats
                  ints("u2", "uvec2", {1, 2, 3, 4, 5, 6}),
                  ints("ia", "int[2]", {0, 1, 0, 2, 0, 3})};
  const EvaluatedRows rows = same_everywhere(fragment(text), table);
  CHECK(value_at(*find_values(rows.outputs, "c"), 0, 0) == -2147483648.0);
  CHECK(find_values(rows.outputs, "d")->bits[3] == 0x7fc00001u);
  CHECK(value_at(*find_values(rows.outputs, "e"), 2, 5) == 18);
  CHECK(std::signbit(value_at(*find_values(rows.outputs, "a"), 0, 0)));
  CHECK(value_at(*find_values(rows.outputs, "g"), 1, 0) == 9 + 5 * 2 + 11 + 7);
}

TEST_CASE("uniforms of every kind are set by name, matrices by column") {
  const std::string text =
      "struct Light { vec3 colour; float power[2]; mat2 turn; };\n"
      "uniform Light lights[2]; uniform bool on; uniform bvec2 on2; uniform mat3x2 m; uniform uvec3 u; uniform ivec2 "
      "i[2];\n"
      "uniform Block { float first; mat2x3 turn; vec3 list[2]; bool flag; } block;\n"
      "layout(std140, row_major) uniform Plain { mat3x2 rows_of; int last; };\n"
      "uniform Pair { float lead; vec3 tail; } pairs[2];\nuniform vec2 given = vec2(0.5, 8.0);\n"
      "in float x;\nout vec4 a; out vec4 b; out ivec4 c; out vec4 d; out vec4 e;\n"
      "void main() {\n"
      "  e = vec4(pairs[0].tail.z, pairs[1].lead, given);\n"
      "  a = vec4(lights[1].colour, lights[1].power[1]); b = vec4(lights[1].turn[1], m[2]);\n"
      "  c = ivec4(on && !on2.x && on2.y && block.flag ? 1 : 0, int(u.z), i[1].y, last);\n"
      "  d = vec4(block.first + x, block.turn[1].z, block.list[1].y, rows_of[2].y);\n}\n";
  ValueTable table{2, {floats("x", "float", {0, 1})}, {}, {}, {}};
  for (const std::string light : {"lights[0]", "lights[1]"}) {
    const float k = light == "lights[0]" ? 0 : 100;
    table.uniforms.push_back(floats(light + ".colour", "vec3", {k + 1, k + 2, k + 3}));
    table.uniforms.push_back(floats(light + ".power", "float[2]", {k + 4, k + 5}));
    table.uniforms.push_back(floats(light + ".turn", "mat2", {k + 6, k + 7, k + 8, k + 9}));
  }
  for (Values values :
       {ints("on", "bool", {1}), ints("on2", "bvec2", {0, 1}), floats("m", "mat3x2", {1, 2, 3, 4, 5, 6}),
        ints("u", "uvec3", {1, 2, 7}), ints("i", "ivec2[2]", {1, 2, 3, -4}), floats("Block.first", "float", {.5f}),
        floats("block.turn", "mat2x3", {1, 2, 3, 4, 5, 6}), floats("Block.list", "vec3[2]", {1, 2, 3, 4, 5, 6}),
        ints("Block.flag", "bool", {1}), floats("rows_of", "mat3x2", {1, 2, 3, 4, 5, 6}), ints("last", "int", {-9}),
        floats("Pair[0].lead", "float", {1}), floats("pairs[0].tail", "vec3", {2, 3, 4}),
        floats("Pair[1].lead", "float", {5}), floats("Pair[1].tail", "vec3", {6, 7, 8})})
    table.uniforms.push_back(values);
  const EvaluatedRows rows = same_everywhere(fragment(text), table);
  const auto row = [&](const char* name, std::size_t r) {
    std::vector<double> values;
    for (std::uint32_t c = 0; c < 4; ++c) values.push_back(value_at(*find_values(rows.outputs, name), r, c));
    return values;
  };
  CHECK(row("a", 0) == std::vector<double>{101, 102, 103, 105});
  CHECK(row("b", 1) == std::vector<double>{108, 109, 5, 6});
  CHECK(row("c", 1) == std::vector<double>{1, 7, -4, -9});
  CHECK(row("d", 1) == std::vector<double>{1.5, 6, 5, 6});
  CHECK(row("e", 0) == std::vector<double>{4, 5, 0.5, 8});
}

TEST_CASE("inputs, outputs, uniforms and blocks may have names that became keywords after the shader's version") {
  const std::string text =
      "#version 330\nin float patch; in vec2 buffer[2]; uniform vec2 precise;\n"
      "uniform subroutine { float u; } block;\nlayout(location = 0) out vec3 sample;\n"
      "void main() { sample = vec3(precise * buffer[1] + patch, block.u); }\n";
  ValueTable table{2, {}, {}, {}, {}};
  table.inputs = {floats("patch", "float", {1, 2}), floats("buffer", "vec2[2]", {0, 0, 3, 4, 0, 0, 5, 6})};
  table.uniforms = {floats("precise", "vec2", {10, 100}), floats("subroutine.u", "float", {7})};
  const EvaluatedRows rows = same_everywhere(fragment(text), table);
  CHECK(rows.outputs.at(0).name == "sample");
  CHECK(value_at(rows.outputs[0], 1, 0) == 52);
  CHECK(value_at(rows.outputs[0], 1, 1) == 602);
  CHECK(value_at(rows.outputs[0], 1, 2) == 7);
}

TEST_CASE("functions may have names that became built-in functions after the shader's version") {
  const std::string text =
      "#version 330\nin float x;\nstruct S { float findLSB; };\nuniform S bitfieldExtract;\n"
      "layout(location = 0) out vec4 r;\nfloat ldexp(float x, float n) { return x + n; }\n"
      "int bitCount(float x) { return 7; }\nfloat interpolateAtOffset(float x, vec2 by) { return x + by.x; }\n"
      "float dFdxFine(float x) { return 2.0 * x; }\nfloat findLSB(float x) { return x; }\n"
      "void main() { r = vec4(ldexp(x, 2), bitCount(3) + findLSB(bitfieldExtract.findLSB), "
      "interpolateAtOffset(x, vec2(1, 2)), dFdxFine(x)); }\n";
  const EvaluatedRows rows = same_everywhere(
      fragment(text), {1, {floats("x", "float", {5})}, {floats("bitfieldExtract.findLSB", "float", {4})}, {}, {}});
  const std::vector<double> expected = {7, 11, 6, 10};
  for (std::uint32_t k = 0; k < 4; ++k) CHECK(value_at(rows.outputs.at(0), 0, k) == expected[k]);
}

TEST_CASE("fma is there in every version that has it, or whose extension has") {
  for (const std::string head :
       {"#version 450\n", "#version 330\n#extension GL_ARB_gpu_shader5 : require\n",
        "#version 320 es\nprecision highp float;\n",
        "#version 310 es\n#extension GL_EXT_gpu_shader5 : require\nprecision highp float;\n"}) {
    CAPTURE(head);
    const EvaluatedRows rows = same_everywhere(
        fragment(head +
                 "in highp float x;\nlayout(location = 0) out highp float r;\nvoid main() { r = fma(x, 2.0, 1.0); }\n"),
        {2, {floats("x", "float", {5, -0.5f})}, {}, {}, {}});
    CHECK(value_at(rows.outputs.at(0), 0, 0) == 11);
    CHECK(value_at(rows.outputs[0], 1, 0) == 0);
  }
}

TEST_CASE("arrays take their sizes from what they start with") {
  const std::string text =
      "#version 450\nin float x;\nlayout(location = 0) out vec4 r;\nstruct S { int[2] a; };\n"
      "float[2] turned(float[2] v) { return float[](v[1], v[0]); }\n"
      "void main() {\n  int[] a = int[](1, 2, 3);\n  int b[] = {4, 5};\n  int[][] c = int[][](int[](6, 7), int[](8, "
      "9));\n"
      "  S s = {{10, 11}};\n  float[] t = turned(float[](x, 2.0));\n"
      "  r = vec4(a.length() * 100 + a[1], b[1] + c.length(), c[1][0] + s.a[1], t[0] - t[1]);\n}\n";
  const EvaluatedRows rows = same_everywhere(fragment(text), {1, {floats("x", "float", {5})}, {}, {}, {}});
  const std::vector<double> expected = {302, 7, 19, -3};
  for (std::uint32_t k = 0; k < 4; ++k) CHECK(value_at(rows.outputs.at(0), 0, k) == expected[k]);
}

TEST_CASE("inputs at the centroid and at a sample are those of the pixel, on every machine") {
  const std::string body =
      "in highp float x;\nin highp vec3 v[2];\nlayout(location = 0) out highp vec4 r;\n"
      "void main() { int i = 1; r = vec4(interpolateAtCentroid(x), interpolateAtSample(v[i], 0)); }\n";
  for (const std::string head : {"#version 450\n", "#version 330\n#extension GL_ARB_gpu_shader5 : require\n",
                                 "#version 320 es\nprecision highp float;\n",
                                 "#version 310 es\n#extension GL_OES_shader_multisample_interpolation : require\n"
                                 "precision highp float;\n"}) {
    CAPTURE(head);
    const EvaluatedRows rows = same_everywhere(
        fragment(head + body),
        {2,
         {floats("x", "float", {5, -0.1f}), floats("v", "vec3[2]", {1, 2, 3, 4, 6, 7, 0, 0, 0, 8, 9, 11})},
         {},
         {},
         {}});
    const std::vector<double> expected = {5, 4, 6, 7, double(-0.1f), 8, 9, 11};
    for (std::uint32_t k = 0; k < 8; ++k) CHECK(value_at(rows.outputs.at(0), k / 4, k % 4) == expected[k]);
  }
}

TEST_CASE("functions hide the built-in ones of their names from their declaration on") {
  const std::string text =
      "#define OWN(T, f) T f(T v) { return v + T(100); }\n#define CALL(f, v) f(v)\n"
      "in float x;\nlayout(location = 0) out vec4 a; layout(location = 1) out vec4 b; layout(location = 2) out vec4 "
      "c;\n"
      "float early(float v) { return abs(v) + max(v, 2); }\n"
      "float abs(float v) { return v + 100.0; }\n"  // as the built-in one
      "OWN(float, sign)\n"
      "float max(float v, int n);\n"
      "float bitfieldInsert(float v, int b, int k, int n) { return v + 100.0; }\n"
      "float dot(vec2 u, float n) { return n; }\nvec2 dot(vec2 u, vec2 v) { return u * v; }\n"
      "int pow(int v, int n) { return n == 0 ? 1 : n == 1 ? v : v * v; }\n"
      // of the text around the shader's
      "float texelFetch(float v) { return v; }\nfloat min(float v) { return v; }\n"
      "float uintBitsToFloat(float v) { return v; }\nfloat floatBitsToUint(float v) { return v; }\n"
      "float textureSize(float v) { return v; }\nfloat average(float u, float v) { return (u + v) * 0.5; }\n"
      "struct S { float length; };\nfloat length(float v[2]) { return float(v.length()) + 40.0; }\n"
      "void main() {\n"
      "  a = vec4(early(x), abs(x), CALL(sign, x), sign(3));\n"
      "  b = vec4(max(int(x), 1), bitfieldInsert(int(x), 1, 2, 3), dot(vec2(x, 2), vec2(3, 4)));\n"
      "  float distance = pow(3, 2) + texelFetch(min(uintBitsToFloat(floatBitsToUint(textureSize(x)))));\n"
      "  c = vec4(distance, average(1, 2), length(float[2](x, x)), S(x).length);\n}\n"
      "float max(float v, int n) { return v + 1000.0; }\n";
  const EvaluatedRows rows = same_everywhere(fragment(text), {1, {floats("x", "float", {-1})}, {}, {}, {}});
  const std::vector<std::vector<double>> expected = {{3, 99, 99, 103}, {999, 99, -3, 8}, {8, 1.5, 42, -1}};
  for (std::size_t output = 0; output < 3; ++output)
    for (std::uint32_t k = 0; k < 4; ++k) CHECK(value_at(rows.outputs.at(output), 0, k) == expected[output][k]);
}

TEST_CASE("uniforms that differ by row are what each row sees") {
  ValueTable table{5, {floats("x", "float", {1, 2, 3, 4, 5})}, {floats("k", "float", {10, 20, 10, 20, 30})}, {}, {}};
  const EvaluatedRows rows =
      same_everywhere(fragment("in float x; uniform float k;\nout float r;\nvoid main() { r = x * k; }\n"), table);
  for (std::size_t i = 0; i < 5; ++i) CHECK(value_at(rows.outputs[0], i, 0) == std::vector{10, 40, 30, 80, 150}[i]);
}

TEST_CASE("discarded rows, depth, place, facing and derivatives are the same everywhere") {
  const std::string text =
      "in float x;\nlayout(location = 1) out vec4 place; layout(location = 0) out vec2 change;\n"
      "void main() {\n  change = vec2(dFdx(x), dFdy(x));\n  if (x == 3.0) discard;\n"
      "  place = vec4(gl_FragCoord.xy, gl_FragCoord.z + gl_FragCoord.w, gl_FrontFacing ? float(gl_PrimitiveID) : "
      "-1.0);\n"
      "  gl_FragDepth = x * 2.0;\n}\n";
  std::vector<float> x;
  for (int i = 0; i < 300; ++i) x.push_back(float(i * i % 37));
  const EvaluatedRows rows = same_everywhere(fragment(text), {300, {floats("x", "float", x)}, {}, {}, {}}, false);
  for (std::size_t i = 0; i < 300; ++i) CHECK(int(rows.kept[i]) == int(x[i] != 3));
  CHECK(value_at(*find_values(rows.outputs, "gl_FragDepth"), 2, 0) == double(2 * x[2]));
  CHECK(value_at(*find_values(rows.outputs, "change"), 5, 0) == double(x[5] - x[4]));
  CHECK(value_at(*find_values(rows.outputs, "place"), 129, 1) == 2.5);
}

TEST_CASE("each row stores where its own index says") {
  // softpipe takes a store's index from the first pixel of a quad. Rows enough for several lines of the grid.
  const std::string text =
      "in float x; flat in int i; out vec4 r; out vec2 place;\n"
      "void main() {\n"
      "  float list[3]; mat2 m = mat2(0.0); vec4 v = vec4(0.0); vec2 pairs[2];\n"
      "  list[0] = list[1] = list[2] = 0.0;\n"
      "  pairs[0] = pairs[1] = vec2(0.0);\n"
      "  list[i % 3] = x; m[i & 1][i >> 1 & 1] = x; v[i & 3] = x; pairs[i & 1] = vec2(x, -x);\n"
      "  if (i == 6) discard;\n"
      "  r = vec4(list[0] + 2.0 * list[1], m[0].x + 2.0 * m[1].y, v.x + 2.0 * v.z, pairs[1].y);\n"
      "  place = gl_FragCoord.xy;\n"
      "}\n";
  ValueTable table{523, {}, {}, {}, {}};
  std::vector<float> x;
  std::vector<std::int64_t> i;
  for (int row = 0; row < 523; ++row) {
    x.push_back(float(row + 1));
    i.push_back(row * 5 % 7);
  }
  table.inputs = {floats("x", "float", x), ints("i", "int", i)};
  const EvaluatedRows rows = same_everywhere(fragment(text), table);
  CHECK(value_at(*find_values(rows.outputs, "r"), 0, 0) == 1);
  CHECK(value_at(*find_values(rows.outputs, "r"), 3, 3) == -4);
  CHECK(rows.kept[4] == 0);
}

TEST_CASE("products of 64 bits are right whatever the compiler knows of their factors") {
  const std::string text =
      "flat in uint u; flat in int i; out uvec4 a; out uvec4 b; out uvec2 c;\n"
      "void multiply(uint x, out uvec2 product) { umulExtended(x, 1u, product.x, product.y); }\n"
      "void main() {\n"
      "  uint h, l; uvec2 h2, l2; int ih, il; uvec2 product;\n"
      "  umulExtended(u, 0xffffffffu, h, l); a.xy = uvec2(h, l);\n"
      "  multiply(u, product); a.zw = product;\n"
      "  if (u == 7u) a.zw = uvec2(3u); else umulExtended(7u, ~1u, a.z, a.w);\n"
      "  imulExtended(i, -1, ih, il); b.xy = uvec2(ih, il);\n"
      "  imulExtended(i, 1, ih, il); b.zw = uvec2(ih, il);\n"
      "  umulExtended(uvec2(u), uvec2(~0u, 1u), h2, l2); c = h2 * 3u + l2;\n"
      "}\n";
  ValueTable table{4, {}, {}, {}, {}};
  table.inputs = {ints("u", "uint", {0, 7, 4294967295, 2147483648}),
                  ints("i", "int", {0, -1, 2147483647, -2147483648})};
  const EvaluatedRows rows = same_everywhere(fragment(text), table);
  const std::vector<std::uint32_t>& a = find_values(rows.outputs, "a")->bits;
  CHECK(std::vector(a.begin() + 4, a.begin() + 8) == std::vector{6u, 4294967289u, 3u, 3u});
  CHECK(std::vector(a.begin() + 8, a.begin() + 12) == std::vector{4294967294u, 1u, 6u, 4294967282u});
  const std::vector<std::uint32_t>& b = find_values(rows.outputs, "b")->bits;
  CHECK(std::vector(b.begin() + 12, b.end()) == std::vector{0u, 2147483648u, 4294967295u, 2147483648u});
}

TEST_CASE("softpipe refuses derivatives, which are coarse there, and evaluates the next shader") {
  const auto targets = test::every_target();
  const auto softpipe = std::find_if(targets.begin(), targets.end(),
                                     [](const EvaluationTarget& t) { return t.backend == Backend::softpipe; });
  if (softpipe == targets.end()) return;
  Evaluator evaluator;
  const ValueTable table{1, {floats("x", "float", {3})}, {}, {}, {}};
  CHECK_THROWS_WITH_AS(
      evaluator.run(fragment("in float x; out float r;\nvoid main() { r = fwidth(x); }\n"), table, *softpipe),
      doctest::Contains("fwidth is not evaluated on softpipe"), BackendError);
  const EvaluatedRows rows =
      evaluator.run(fragment("in float x; out float r;\nvoid main() { r = x; }\n"), table, *softpipe);
  CHECK(value_at(rows.outputs[0], 0, 0) == 3);
}

TEST_CASE("textures and storage buffers are read by name") {
  ValueTable table{2, {floats("x", "float", {0, 1})}, {}, {}, {}};
  table.textures = {{"map", TextureKind::two_d, 2, 1, 1, Filter::nearest, Wrap::repeat, {1, 2, 3, 4, 5, 6, 7, 8}}};
  table.buffers = {{"List", true, std::vector<std::byte>(16, std::byte{0x40})}};
  const EvaluatedRows rows = same_everywhere(
      fragment("in float x; uniform sampler2D map;\nlayout(std430) readonly buffer List { float list[]; };\n"
               "out vec2 r;\nvoid main() { r = vec2(texelFetch(map, ivec2(int(x), 0), 0).w, list[int(x)]); }\n"),
      table);
  CHECK(value_at(rows.outputs[0], 1, 0) == 8);
  CHECK(value_at(rows.outputs[0], 1, 1) == doctest::Approx(3.00392));
}

TEST_CASE("textures and buffers that a table does not have are refused where they are declared") {
  Evaluator evaluator;
  const ValueTable table{1, {floats("x", "float", {0})}, {}, {}, {}};
  const auto refusal = [&](const std::string& text) {
    return error_of([&] { evaluator.run(fragment("in float x; out float r;\n" + text), table, {}); });
  };
  CHECK(refusal("// buffer List\n/* buffer List\n */ struct S { float List; };\nlayout(std430) readonly buffer List { "
                "float list[]; } it;\nvoid main() { r = it.list[0]; }\n")
            .find("test.frag:5: storage buffer List: ") == 0);
  CHECK(refusal("#line 40\nuniform sampler2D first,\n  maps[2];\n"
                "void main() { r = texture(first, vec2(x)).x + texture(maps[1], vec2(x)).x; }\n")
            .find("test.frag:40: texture first: ") == 0);
  CHECK(
      refusal("uniform float k;\n\nuniform highp\n  samplerCube cube;\nvoid main() { r = texture(cube, vec3(x)).x; }\n")
          .find("test.frag:5: texture cube: ") == 0);
}

TEST_CASE("of a denormal and another number min and max give zero where it is chosen, here as on llvmpipe") {
  const ShaderSource shader = fragment(
      "in float x; in float y; out vec3 r;\n"
      "void main() { r = vec3(min(x, y), max(x, y), clamp(x, y, 1.0)); }\n");
  const float tiny = 0x1p-130F;
  const std::vector<float> x{tiny, 1, tiny, -tiny, 0, tiny}, y{1, tiny, -1, -1, tiny, 0};
  const EvaluatedRows rows =
      same_everywhere(shader, {6, {floats("x", "float", x), floats("y", "float", y)}, {}, {}, {}}, false);
  CHECK(value_at(rows.outputs[0], 0, 0) == 0);
  CHECK(value_at(rows.outputs[0], 1, 0) == 0);
  CHECK(value_at(rows.outputs[0], 2, 1) == 0);
}

#if TWINSHADE_HAS_GL
TEST_CASE("division written out in integers gives the processor's bits, denormals and special values included") {
  setenv("TWINSHADE_GPU", "0", 1);  // Mesa's processor where there is no card
  EvaluatorOptions options;
  options.written_out = true;
  Evaluator evaluator(options);
  const ShaderSource shader = fragment(
      "in float x; in float y; layout(location = 0) out vec4 r; layout(location = 1) out vec2 s;\nvoid main() {\n"
      "  precise vec2 quotient = vec2(x, y) / y; precise float root = sqrt(x * x + y), last = (x * y + x) / (x - y);\n"
      "  r = vec4(quotient, root, last); s = vec2(min(x, y), clamp(x, y, 2.0));\n}\n");
  ValueTable table{0, {}, {}, {}, {}};
  std::vector<float> x, y;
  const float values[] = {0, -0.0F, 1, -3, 0.1F, 7e37F, 3e-38F, 0x1p-130F, INFINITY, -INFINITY, NAN, 123.456F};
  for (const float a : values)
    for (const float b : values) x.push_back(a), y.push_back(b);
  table.rows = x.size();
  table.inputs = {floats("x", "float", x), floats("y", "float", y)};
  const std::vector<std::string> cpu =
      test::listing(evaluator.run(shader, table, {Backend::cpu, Number::lanes4, Isa::baseline}));
  const std::vector<std::string> card = test::listing(evaluator.run(shader, table, {Backend::gpu, {}, {}}));
  unsetenv("TWINSHADE_GPU");
  REQUIRE(cpu.size() == card.size());
  for (std::size_t i = 0; i < cpu.size(); ++i) CHECK(cpu[i] == card[i]);
}
#endif

TEST_CASE("in double the outputs keep every digit") {
  Evaluator evaluator;
  const EvaluatedRows rows = evaluator.run(
      fragment("in float x; flat in int i;\nout float r; out int j;\nvoid main() { r = x / 3.0; j = i + 1; }\n"),
      {1, {floats("x", "float", {1}), ints("i", "int", {41})}, {}, {}, {}}, {Backend::cpu, Number::float64, {}});
  CHECK(value_at(*find_values(rows.outputs, "r"), 0, 0) == 1.0 / 3.0);
  CHECK(value_at(*find_values(rows.outputs, "j"), 0, 0) == 42);
}

TEST_CASE("shaders prepared in batches are those that were asked for; a bad one spoils no other") {
  std::vector<ShaderSource> shaders;
  for (int i = 0; i < 7; ++i) {
    const std::string body = i == 3 ? "r = undefined_name;" : "r = float(" + std::to_string(i) + ") + x;";
    shaders.push_back(resolve_shader("s" + std::to_string(i),
                                     "in float x;\nout float r;\nvoid main() { " + body + " }\n",
                                     "s" + std::to_string(i) + ".frag"));
  }
  const std::vector<EvaluationTarget> targets{{Backend::cpu, Number::lanes4, Isa::baseline},
                                              {Backend::cpu, Number::scalar, Isa::baseline}};
  Evaluator evaluator;
  evaluator.prepare(shaders, targets);
  for (int i = 0; i < 7; ++i)
    for (const EvaluationTarget& target : targets) {
      const auto run = [&] {
        return evaluator.run(shaders[std::size_t(i)], {1, {floats("x", "float", {.5f})}, {}, {}, {}}, target);
      };
      if (i == 3)
        CHECK(error_of(run).find("s3.frag:3") != std::string::npos);
      else
        CHECK(value_at(run().outputs[0], 0, 0) == i + .5);
    }
}

TEST_CASE("what does not fit is refused by name") {
  Evaluator evaluator;
  const ShaderSource shader =
      fragment("in vec2 uv; uniform float scale;\nout float r;\nvoid main() { r = uv.x * scale; }\n");
  const Values uv = floats("uv", "vec2", {1, 2}), scale = floats("scale", "float", {1});
  const auto refusal = [&](const std::vector<Values>& inputs, const std::vector<Values>& uniforms,
                           std::size_t rows = 1) {
    return error_of([&] { evaluator.run(shader, {rows, inputs, uniforms, {}, {}}, {}); });
  };
  CHECK(refusal({uv}, {scale}) == "");
  CHECK(refusal({}, {scale}) == "test.frag: input uv (vec2) has no values in the table");
  CHECK(refusal({uv, floats("vu", "vec2", {1, 2})}, {scale}) == "test.frag: unknown input 'vu'; did you mean 'uv'?");
  CHECK(refusal({floats("uv", "vec3", {1, 2, 3})}, {scale}) ==
        "test.frag: input uv is vec2 in the shader, but vec3 in the table");
  CHECK(refusal({uv}, {}) == "test.frag: uniform scale (float) has no value in the table");
  CHECK(refusal({uv}, {scale, floats("skale", "float", {1})}) ==
        "test.frag: unknown uniform 'skale'; did you mean 'scale'?");
  CHECK(refusal({uv}, {ints("scale", "int", {1})}) ==
        "test.frag: uniform scale is float in the shader, but int in the table");
  CHECK(refusal({uv}, {scale}, 2) == "test.frag: input uv has 1 rows of vec2, but the table has 2");

  ValueTable of_file{1, {uv}, {}, {}, {}};
  of_file.origin = "cases.json";
  CHECK(error_of([&] { evaluator.run(shader, of_file, {}); }) ==
        "cases.json: uniform scale (float) has no value in the table (shader: test.frag)");

  std::string many = "in float x;\n", body;
  for (int i = 0; i < 9; ++i) {
    many += "out float r" + std::to_string(i) + ";\n";
    body += " r" + std::to_string(i) + " = x;";
  }
  CHECK(error_of([&] {
          evaluator.run(fragment(many + "void main() {" + body + " }\n"), {1, {floats("x", "float", {1})}, {}, {}, {}},
                        {});
        }).find("9 outputs, but at most 8") != std::string::npos);
}
