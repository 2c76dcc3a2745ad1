// What a translation in lower precision computes in half, and that others say nothing of it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "base/error.h"
#include "cpu_shaders/translate/emit_types.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string translated(const std::string& glsl, Precision precision) {
  ShaderSource source = resolve_shader("sample", glsl, "sample.frag");
  source.precision = precision;
  TranslateOptions options;
  options.readable = true;
  std::string text = translate(source, options).cpp;
  // Up to the reflection, which has the hash, and without the header: what differs by design.
  text.erase(text.find("constexpr ShaderVariable"));
  if (const std::size_t at = text.find(kHalfInclude); at != std::string::npos)
    text.erase(at, std::string(kHalfInclude).size());
  for (std::size_t at; (at = text.find("\n        ")) != std::string::npos;)  // lines that were too long
    text.replace(at, text.find_first_not_of(" \n", at) - at, " ");
  return text;
}

const std::string kDesktop =
    "#version 450\nin vec3 n;\nuniform mat3 m;\nout vec4 c;\n"
    "void main() {\n  vec3 v = normalize(m * n);\n  c = vec4(v * 0.1, v.x < 0.3 ? 1.0 : sin(v.y));\n}\n";

const std::string kMobile =
    "#version 310 es\nprecision mediump float;\nin vec3 n;\nin highp vec2 uv;\nuniform highp float scale;\n"
    "uniform lowp sampler2D map;\nstruct Light { vec3 color; highp float reach; };\nuniform Light light;\n"
    "layout(location = 0) out vec4 c;\n"
    "float twice(highp float x) { return x + x; }\n"
    "void main() {\n"
    "  highp float far = uv.x * scale;\n"
    "  vec3 v = normalize(n);\n"
    "  float x = n.x;\n"
    "  v *= light.color * twice(far);\n"
    "  if (x < 0.1) v += texture(map, uv).rgb;\n"
    "  far += light.reach;\n"
    "  c = vec4(v, 0.1);\n"
    "}\n";

}  // namespace

TEST_CASE("a shader without precision qualifiers is the same in mediump, and full says nothing of halves") {
  CHECK(translated(kDesktop, Precision::mediump) == translated(kDesktop, Precision::full));
  for (const std::string& glsl : {kDesktop, kMobile}) CHECK_FALSE(holds(translated(glsl, Precision::full), "half"));
}

TEST_CASE("in mediump what has no highp operand is computed in half") {
  const std::string text = translated(kMobile, Precision::mediump);
  for (const char* part : {"far = uv().x * scale;",                          // highp alone
                           "return glsl::normalize(x...); }, to_half(n())",  // a built-in, each step in half
                           "const F x = to_half(n().x);",                    // a component of an input
                           "to_half(light.color)",                           // a member of a struct
                           "to_half(twice(far))",                            // a function whose result is mediump
                           "const F choice = to_half(x + x);",               // highp within
                           "to_half(glsl::texture(map_, uv()))",             // highp coordinates, lowp texels
                           "far = far + light.reach;",
                           "return x < y; }, to_half(x), UF(0x1.99999ap-4f)",  // the constant becomes a half there
                           "c = to_half(vec4("})
    CHECK_MESSAGE(holds(text, part), part, "\n", text);
}

TEST_CASE("in half everything is, constants too") {
  const std::string text = translated(kDesktop, Precision::half);
  CHECK_MESSAGE(
      holds(text,
            "of_halves([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x * y; }, to_half(m), to_half(n()))"),
      text);
  CHECK_MESSAGE(holds(text, "0x1.998p-4f"), text);  // 0.1
  CHECK_FALSE(holds(text, "0x1.99999ap-4f"));
}

TEST_CASE("in half bit casts are refused by name, transcendentals of shaders/exact/ are not made of them") {
  const std::string casts =
      "#version 450\nin float x;\nout float c;\nvoid main() {\n  c = float(floatBitsToInt(x));\n}\n";
  CHECK_NOTHROW(translated(casts, Precision::mediump));
  CHECK_THROWS_WITH_AS(translated(casts, Precision::half),
                       doctest::Contains("sample.frag:5: floatBitsToInt: cannot be evaluated in half"), UserError);
  const std::string served =
      "#version 450\n#include \"exact/exp2.glsl\"\nin float x;\nout float c;\nvoid main() { c = exact_exp2(x); }\n";
  CHECK(holds(translated(served, Precision::half), "if constexpr (true) {"));
  CHECK(translated(served, Precision::mediump) == translated(served, Precision::full));
}

TEST_CASE("constants become the nearest halves, ties the even ones") {
  const auto nearest = [](float x) {
    std::uint32_t bits;
    std::memcpy(&bits, &x, 4);
    bits = spirv::nearest_half(bits);
    std::memcpy(&x, &bits, 4);
    return x;
  };
  CHECK(nearest(0.1f) == 0.0999755859375f);
  CHECK(nearest(2049) == 2048);
  CHECK(nearest(2051) == 2052);
  CHECK(nearest(65519.99f) == 65504);
  CHECK(nearest(-65520) == -INFINITY);
  CHECK(nearest(0x1p-25f) == 0);
  CHECK(nearest(-0x1.8p-25f) == -0x1p-24f);
  CHECK(std::signbit(nearest(-0.0f)));
  CHECK(std::isnan(nearest(NAN)));
}

}  // namespace twinshade
