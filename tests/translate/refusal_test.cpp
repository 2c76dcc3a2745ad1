// What is not supported is refused: one line with file, line, construct and remedy.
#include <doctest/doctest.h>

#include "base/error.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

std::string refusal(const std::string& text) {
  try {
    translate(resolve_shader("bad", text, "bad.frag"));
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

void check_refused(const std::string& text, int line, const std::string& construct) {
  const std::string message = refusal(text);
  const std::string position = "bad.frag:" + std::to_string(line) + ": ";
  CAPTURE(text);
  CHECK_MESSAGE(message.rfind(position, 0) == 0, message);
  CHECK_MESSAGE(message.find(construct) != std::string::npos, message);
  CHECK_MESSAGE(message.find('\n') == std::string::npos, message);
}

const std::string kHead = "#version 450\nout vec4 color;\n";

}  // namespace

TEST_CASE("declarations that cannot be bound are refused by name") {
  check_refused(kHead + "uniform sampler3D volume;\nvoid main() { color = texture(volume, vec3(0)); }\n", 3, "volume");
  check_refused(kHead + "\nuniform isampler2D ids;\nvoid main() { color = vec4(texelFetch(ids, ivec2(0), 0)); }\n", 4,
                "ids");
  check_refused(kHead + "uniform sampler2DShadow shadow;\nvoid main() { color = vec4(texture(shadow, vec3(0))); }\n", 3,
                "shadow");
  check_refused(kHead + "uniform samplerCubeArray cubes;\nvoid main() { color = texture(cubes, vec4(0)); }\n", 3,
                "cubes");
  check_refused(kHead + "layout(rgba8) uniform image2D canvas;\nvoid main() { color = imageLoad(canvas, ivec2(0)); }\n",
                3, "canvas");
  check_refused(
      kHead + "struct M { sampler2D map; };\nuniform M m;\nvoid main() { color = texture(m.map, vec2(0)); }\n", 4,
      "sampler in a struct");
  check_refused(kHead + "layout(origin_upper_left) in vec4 gl_FragCoord;\nvoid main() { color = gl_FragCoord; }\n", 3,
                "origin_upper_left");
  check_refused("#version 450\nlayout(location = 0, index = 1) out vec4 second;\nvoid main() { second = vec4(1); }\n",
                2, "second");
  check_refused(kHead + "void main() { gl_SampleMask[0] = 1; color = vec4(1); }\n", 3, "gl_SampleMask");
  check_refused(kHead + "in float gl_ClipDistance[1];\nvoid main() { color = vec4(gl_ClipDistance[0]); }\n", 3,
                "gl_ClipDistance");
  check_refused(kHead + "layout(constant_id = 1) const int n = 2;\nvoid main() { color = vec4(n); }\n", 3,
                "constant_id");
  check_refused(kHead + "void main() { color = vec4(gl_PointCoord, 0, 1); }\n", 3, "gl_PointCoord");
  check_refused("#version 330\nin vec4 a;\nvoid main() { gl_FragColor = a; }\n", 3, "gl_FragColor");
  check_refused("#version 330\nin vec4 a;\nvoid main() { gl_FragData[1] = a; }\n", 3, "gl_FragData");
  for (const char* written : {"gl_FragColor", "gl_FragData[0]"})  // of GLSL 4.50, as without a #version
    check_refused(std::string("void main() {\n  ") + written + " = vec4(1); }\n", 2, "declare an output: out vec4");
}

// In all versions, whose tables of functions are made one by one; whether or not the extension is asked for.
TEST_CASE("what is of old GLSL or of GLSL for Vulkan is refused with what to write instead") {
  check_refused("varying vec2 uv;\nvoid main() {}\n", 1, "(of old GLSL: write in)");
  check_refused("attribute vec2 uv;\nvoid main() {}\n", 1, "write in)");
  const std::string map = "uniform sampler2D map;\n";
  check_refused(kHead + map + "void main() { color = texture2D(map, vec2(0)); }\n", 4, "(of old GLSL: write texture)");
  check_refused(kHead + map + "void main() { color = texture2DProjLod(map, vec3(0), 0.); }\n", 4,
                "write textureProjLod)");
  check_refused(kHead + "layout(input_attachment_index = 0) uniform subpassInput last;\nvoid main() {}\n", 3,
                "(write sampler2D, an input or a uniform)");
  CHECK(refusal(kHead + "void mainImage() { color = vec4(1); }\n") == "bad.frag: the shader has no main()");
}

TEST_CASE("functions of extensions are refused with the reason, and one's own may have their names") {
  const std::string es = "#version 310 es\nprecision highp float; out vec4 color;\n",
                    reason = " (of extensions none is translated";
  for (const std::string& head : {std::string("#version 330\nout vec4 color;\n"), kHead, es}) {
    check_refused(head + "void main() { color = subgroupAdd(vec4(1)); }\n", 3, "'subgroupAdd'");
    check_refused(head + "void main() { color = subgroupAdd(vec4(1)); }\n", 3, reason);
    CHECK(
        refusal(head + "float subgroupAdd(float x) { return x; }\nvoid main() { color = vec4(subgroupAdd(1.0)); }\n") ==
        "accepted");
  }
  check_refused(kHead +
                    "#extension GL_ARB_shader_ballot : require\n"
                    "void main() { color = vec4(readFirstInvocationARB(1.0)); }\n",
                4, "'readFirstInvocationARB' : no matching overloaded function found" + reason);
  check_refused(kHead + "uniform sampler2D map;\nvoid main() { color = textureClampARB(map, vec2(0), 0.0); }\n", 4,
                reason);
  check_refused(
      kHead +
          "layout(std430, binding = 0) buffer B { int n; };\nvoid main() { color = vec4(atomicLoad(n, 1, 0, 0)); }\n",
      4, "atomicLoad");
  check_refused(kHead +
                    "#extension GL_AMD_shader_trinary_minmax : enable\nin vec3 v;\n"
                    "void main() { color = vec4(min3(v.x, v.y, v.z)); }\n",
                5, "SPV_AMD_shader_trinary_minmax");
  CHECK(refusal(kHead + "void main() { color = texture(1.0); }\n").find(reason) == std::string::npos);
}

TEST_CASE("instructions that mean nothing to us are refused where they stand") {
  const std::string maps =
      kHead + "uniform sampler2D map;\nuniform sampler2D maps[2];\nflat in int k;\nvoid main() {\n";
  check_refused(maps + "  color = vec4(textureQueryLod(map, vec2(0)), 0, 1);\n}\n", 7, "textureQueryLod");
  check_refused(maps + "  color = texture(maps[k], vec2(0));\n}\n", 7, "indexing samplers");
  check_refused(
      kHead + "uniform Block { vec4 a; } blocks[2];\nflat in int k;\nvoid main() {\n  color = blocks[k].a;\n}\n", 6,
      "indexing blocks");
  check_refused(kHead + "in float x;\nvoid main() {\n  color = vec4(interpolateAtOffset(x, vec2(0.25)));\n}\n", 5,
                "interpolateAtOffset");
  check_refused(kHead + "in float x;\nvoid main() { double d = double(x); color = vec4(float(d * d)); }\n", 4,
                "other than float");
}

// glslang's SPIR-V takes components of a scalar there.
TEST_CASE("a struct with bools of a block is refused as a part of another value") {
  check_refused(kHead +
                    "struct S { float v; bool on; };\nlayout(std140) uniform Block { S s; };\nvoid main() {\n  S t;\n"
                    "  t.on = true; t.v = 1.0;\n  S list[2] = S[2](s, t);\n  color = vec4(list[int(t.v)].v);\n}\n",
                8, "assign it to a variable first");
}

TEST_CASE("what extensions add is refused where it stands") {
  check_refused(kHead + "#extension GL_EXT_spirv_intrinsics : require\nvoid main() { color = vec4(1); }\n", 3,
                "#extension GL_EXT_spirv_intrinsics");
  check_refused(kHead +
                    "#ifdef GL_EXT_spirv_intrinsics\n#extension GL_EXT_spirv_intrinsics : enable\n"
                    "#endif\nvoid main() { color = vec4(1); }\n",
                4, "#extension GL_EXT_spirv_intrinsics");
  CHECK(refusal(kHead + "#if 0\n#extension GL_EXT_spirv_intrinsics : require\n#endif\n"
                        "#extension GL_EXT_spirv_intrinsics : disable\nvoid main() { color = vec4(1); }\n") ==
        "accepted");
  const std::string demote = kHead +
                             "#extension GL_EXT_demote_to_helper_invocation : enable\nin float x;\n"
                             "void main() {\n  if (x > 0.0) demote;\n  color = vec4(x);\n}\n";
  check_refused(demote, 6, " OpDemoteToHelperInvocationEXT");
  check_refused(kHead +
                    "#extension GL_AMD_shader_trinary_minmax : enable\nin vec3 v;\n"
                    "void main() {\n  color = vec4(min3(v.x, v.y, v.z));\n}\n",
                6, "SPV_AMD_shader_trinary_minmax");
}

TEST_CASE("glslang's messages come with the author's file and line") {
  check_refused(kHead + "void main() {\n  color = vec3(1.0);\n}\n", 4, "cannot convert");
  check_refused(kHead + "void main() { color = nothing; }\n", 3, "undeclared");
  check_refused("#version 120\nvoid main() {}\n", 1, "GLSL 120");
  check_refused("#version 100\nvoid main() {}\n", 1, "GLSL ES 100");
  check_refused("#version 999\nvoid main() {}\n", 1, "GLSL 999");
  check_refused(kHead + "float half_of(float x);\nvoid main() { color = vec4(half_of(1.0)); }\n", 3,
                "half_of() is declared and called, but has no body");
  CHECK(refusal(kHead) != "accepted");
  const std::string included =
      refusal("#version 450\n#include \"exact/dot.glsl\"\nout vec4 color;\nvoid main() { color = vec4(1) }\n");
  CHECK_MESSAGE(included.rfind("bad.frag:4: ", 0) == 0, included);
}

// Read as the author's version and as 450; each may stop at what only the other accepts.
TEST_CASE("of an earlier version's two readings the complaint about what neither accepts is shown") {
  const std::string newer = "#version 330\nlayout(binding = 1) uniform sampler2D map;\nout vec4 c;\n";
  check_refused(newer + "void main() { c = texture(map, vec2(0)) + nope; }\n", 4, "nope");
  CHECK(refusal(newer + "void main() { c = texture(map, vec2(0)); }\n") == "accepted");
  check_refused(
      "#version 330\nout vec4 c;\nvoid main() {\n  precise float x = float(bitCount(3));\n  c = vec4(x + nope);\n}\n",
      5, "nope");
  check_refused("#version 330\nout vec4 c;\nvoid main() {\n  float sample = 1.0;\n  c = vec4(sample + nope);\n}\n", 5,
                "nope");
  check_refused("#version 330\nout vec4 c;\n#line 200 7\nvoid main() { c = vec4(nope); }\n", 200, "nope");
}

TEST_CASE("recursion is refused with its calls, each at its line") {
  check_refused(kHead + "int f(int n) {\n  return n == 0 ? 1 : f(n - 1);\n}\nvoid main() { color = vec4(f(3)); }\n", 4,
                "f calls itself, and GLSL has no recursion: write a loop; the calls are f -> f (bad.frag:4)");
  check_refused(kHead +
                    "int b(int n);\nint a(int n) {\n  return b(n);\n}\nint b(int n) {\n  if (n > 3)\n    return a(n);\n"
                    "  return n;\n}\nvoid main() { color = vec4(b(3)); }\n",
                5, "the calls are a -> b (bad.frag:5) -> a (bad.frag:9)");
  // A call that gives a global its value is no call of the function above it.
  CHECK(refusal(kHead + "float f(float x) { return x; }\nfloat g = f(0.5);\nvoid main() { color = vec4(g); }\n") ==
        "accepted");
  // An overload is another function.
  CHECK(refusal(kHead + "float f(float x) { return x; }\nfloat f(int n) { return f(float(n)); }\n"
                        "void main() { color = vec4(f(3)); }\n") == "accepted");
}

TEST_CASE("positions follow the author's #line and includes, to the message of each stage") {
  // #line n: the next line is n. With a number for the file, as drivers have it, the file stays.
  check_refused(kHead + "#line 40\n\nvoid main() { color = nothing; }\n", 41, "undeclared");
  check_refused(
      kHead +
          "uniform sampler2D map;\n#line 70\nvoid main() {\n  color = vec4(textureQueryLod(map, vec2(0)), 0, 1);\n}\n",
      71, "textureQueryLod");
  check_refused(kHead + "#line 90\nuniform sampler3D volume;\nvoid main() { color = texture(volume, vec3(0)); }\n", 90,
                "volume");
  check_refused(
      "#version 450\n#include \"exact/dot.glsl\"\nout vec4 color;\n#define TWICE(x) (x + \\\n  x)\n"
      "int f(int n) { return f(n); }\nvoid main() { color = vec4(f(TWICE(1))); }\n",
      6, "f calls itself");
}

TEST_CASE("older and embedded dialects are accepted") {
  // Names that later versions made keywords.
  CHECK(refusal("#version 330\nin vec3 n; out vec4 c; void main() { vec4 sample = vec4(n, 1.0); c = sample; }\n") ==
        "accepted");
  for (const char* version : {"330 core", "400", "410", "420", "430", "440", "450", "460"})
    CHECK(refusal(
              std::string("#version ") + version +
              "\nin vec3 n; uniform sampler2D map; layout(std140) uniform Block { mat3 m; }; out vec4 c;\n"
              "void main() { float list[2] = float[](1.0, 2.0); c = vec4(m * n, list[1]) + texture(map, n.xy); }\n") ==
          "accepted");
  CHECK(refusal("#version 330\nin vec3 n; out vec4 c; void main() { c = vec4(n, 1.0); }\n") == "accepted");
  CHECK(refusal("#version 300 es\nprecision highp float; in vec3 n; out vec4 c; void main() { c = vec4(n, 1.0); }\n") ==
        "accepted");
  // What ES 310 has as functions and keywords is free for ES 300's own.
  CHECK(refusal("#version 300 es\nprecision highp float; in vec4 buffer; out vec4 c; float fma(float a, float b) { "
                "return a - b; } uniform B { float bitCount; }; void main() { c = buffer * fma(bitCount, "
                "2.0); }\n") == "accepted");
  const std::string es300 = "#version 300 es\nprecision highp float; in vec4 a; out vec4 c;\n";
  // Of macros too.
  CHECK(refusal(es300 +
                "#define fma(a, b, c) ((a) * (b) + (c))\n#define buffer a\n#ifndef findMSB\n#define findMSB 2.0\n"
                "#endif\nvoid main() { c = fma(buffer, buffer, a) * findMSB; }\n") == "accepted");
  check_refused(es300 + "#define fma(a, b) ((a) * (b))\nvoid main() {\n  c = fma(a, nope);\n}\n", 5, "nope");
  check_refused(es300 +
                    "#define fma(a, b) ((a) * (b))\nuniform sampler3D m;\nvoid main() {\n"
                    "  c = fma(a, texture(m, a.xyz));\n}\n",
                4, "m");
  CHECK(refusal(es300 + "struct S { float precise; };\nfloat f(float precise) { return precise; }\nvoid main() {\n"
                        "  float precise = f(a.x); precise *= 2.0; S s = S(precise); c = vec4(s.precise); }\n") ==
        "accepted");
  // By an extension it is a keyword all the same; in ES 310 it is reserved.
  CHECK(refusal("#version 300 es\n#extension GL_EXT_gpu_shader5 : enable\nprecision highp float; in vec4 a; out vec4 c;"
                "\nvoid main() { precise vec4 x = a * a; c = x; }\n") == "accepted");
  check_refused(
      "#version 310 es\nprecision highp float; out vec4 c;\nvoid main() {\n  float precise = 1.0;\n"
      "  c = vec4(precise);\n}\n",
      4, "precise");
  CHECK(refusal("#version 310 es\nprecision mediump float; in vec3 n; layout(location = 0) out vec4 c; void main() { c "
                "= vec4(n, 1.0); }\n") == "accepted");
  CHECK(refusal("in vec3 n; out vec4 c; void main() { c = vec4(n, 1.0); }\n") == "accepted");
}

}  // namespace twinshade
