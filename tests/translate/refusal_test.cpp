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
  check_refused(kHead + "uniform float gain = 2.0;\nvoid main() { color = vec4(gain); }\n", 3,
                "initialiser of uniform gain");
  check_refused(kHead + "in Block { vec3 n; } surface;\nvoid main() { color = vec4(surface.n, 1); }\n", 3, "surface");
  check_refused(kHead + "centroid in vec3 n;\nvoid main() { color = vec4(n, 1); }\n", 3, "centroid");
  check_refused(kHead + "uniform Block { vec4 a; } blocks[2];\nvoid main() { color = blocks[1].a; }\n", 3, "blocks");
  check_refused(
      kHead + "struct M { sampler2D map; };\nuniform M m;\nvoid main() { color = texture(m.map, vec2(0)); }\n", 4,
      "sampler in a struct");
  check_refused(kHead + "layout(origin_upper_left) in vec4 gl_FragCoord;\nvoid main() { color = gl_FragCoord; }\n", 3,
                "origin_upper_left");
  check_refused("#version 450\nlayout(location = 0, index = 1) out vec4 second;\nvoid main() { second = vec4(1); }\n",
                2, "second");
  check_refused(kHead + "void main() { color = vec4(gl_SampleID); }\n", 3, "gl_SampleID");
  check_refused(kHead + "void main() { color = vec4(gl_PointCoord, 0, 1); }\n", 3, "gl_PointCoord");
}

TEST_CASE("instructions that mean nothing to us are refused where they stand") {
  const std::string maps =
      kHead + "uniform sampler2D map;\nuniform sampler2D maps[2];\nflat in int k;\nvoid main() {\n";
  check_refused(maps + "  color = textureGather(map, vec2(0));\n}\n", 7, "textureGather");
  check_refused(maps + "\n  color = textureProj(map, vec3(1));\n}\n", 8, "textureProj");
  check_refused(maps + "  color = textureOffset(map, vec2(0), ivec2(1));\n}\n", 7, "textureOffset");
  check_refused(maps + "  color = vec4(textureQueryLod(map, vec2(0)), 0, 1);\n}\n", 7, "textureQueryLod");
  check_refused(maps + "  color = texture(maps[k], vec2(0));\n}\n", 7, "indexing samplers");
  check_refused(kHead + "in float x;\nvoid main() {\n  int e;\n  color = vec4(frexp(x, e));\n}\n", 6, "frexp");
  check_refused(kHead + "in float x;\nvoid main() {\n  color = vec4(ldexp(x, 3));\n}\n", 5, "ldexp");
  check_refused(kHead + "in float x;\nvoid main() {\n  color = vec4(interpolateAtCentroid(x));\n}\n", 5,
                "interpolateAtCentroid");
  check_refused(kHead + "in float x;\nvoid main() {\n  uint c;\n  color = vec4(uaddCarry(uint(x), 2u, c));\n}\n", 6,
                "OpIAddCarry");
  check_refused(kHead + "in float x;\nvoid main() { double d = double(x); color = vec4(float(d * d)); }\n", 4, "other than float");
}

TEST_CASE("glslang's messages come with the author's file and line") {
  check_refused(kHead + "void main() {\n  color = vec3(1.0);\n}\n", 4, "cannot convert");
  check_refused(kHead + "void main() { color = nothing; }\n", 3, "undeclared");
  check_refused("#version 120\nvoid main() {}\n", 1, "GLSL 120");
  check_refused("#version 100\nvoid main() {}\n", 1, "GLSL ES 100");
  CHECK(refusal(kHead + "int f(int n) { return n == 0 ? 1 : f(n - 1); }\nvoid main() { color = vec4(f(3)); }\n")
            .find("ecursion") != std::string::npos);
  CHECK(refusal(kHead) != "accepted");
  const std::string included =
      refusal("#version 450\n#include \"exact/dot.glsl\"\nout vec4 color;\nvoid main() { color = vec4(1) }\n");
  CHECK_MESSAGE(included.rfind("bad.frag:4: ", 0) == 0, included);
}

TEST_CASE("older and embedded dialects are accepted") {
  CHECK(refusal("#version 330\nin vec3 n; out vec4 c; void main() { c = vec4(n, 1.0); }\n") == "accepted");
  CHECK(refusal("#version 300 es\nprecision highp float; in vec3 n; out vec4 c; void main() { c = vec4(n, 1.0); }\n") ==
        "accepted");
  CHECK(refusal("#version 310 es\nprecision mediump float; in vec3 n; layout(location = 0) out vec4 c; void main() { c "
                "= vec4(n, 1.0); }\n") == "accepted");
  CHECK(refusal("in vec3 n; out vec4 c; void main() { c = vec4(n, 1.0); }\n") == "accepted");
}

}  // namespace twinshade
