// Shading on softpipe what another renderer covered.
#include <doctest/doctest.h>

#include "golden/compare_frames.h"
#include "raster/gl/gl_renderer.h"
#include "tests/gl/test_bundles.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;
using test::error_of;
using test::shader;

namespace {

constexpr double kTimeLimit = 60;

const std::string kInputs =
    "in vec3 v_color; in float v_scale; flat in uint v_tag; uniform float k; uniform sampler2D map;\nout vec4 c;\n";

Bundle soup_with_resources() {
  Bundle bundle = test::soup(test::Soup::large, 120, 70, 40, 9);
  bundle.uniforms = {{"k", Scalar::f32, 1, 1, 0, {1.25f}}};
  bundle.textures = {{"map", TextureKind::two_d, 2, 1, 1, Filter::nearest, Wrap::repeat, {1, 2, 3, 4, 5, 6, 7, 8}}};
  return bundle;
}

// Draws on llvmpipe with captured attributes, shades the same pixels on softpipe.
Comparison shaded_alike(const std::string& text) {
  const Bundle bundle = soup_with_resources();
  DrawOptions options;
  options.capture_attributes = true;
  static const auto egl = make_gl_renderer(GlBackend::egl);
  const Frame reference = egl->draw(bundle, shader(text), options);
  const Frame frame = shade_on_softpipe(bundle, shader(text), reference, {}, kTimeLimit);
  CHECK(frame.primitive_id == reference.primitive_id);
  CHECK(frame.coverage == reference.coverage);
  CHECK(frame.depth == reference.depth);
  for (std::size_t p = 0; p < frame.coverage.size(); ++p)
    if (!frame.coverage[p]) REQUIRE(frame.color[p * 4] == 0.0f);
  return compare_frames(reference, frame, CompareScope::shaded_by_a);
}

}  // namespace

TEST_CASE("the exact dialect shades to the same bits on softpipe") {
  const Comparison result =
      shaded_alike(kInputs +
                   "void main() {\n"
                   "  precise vec3 a = v_color * v_scale + v_color.zxy * k;\n"
                   "  precise float b = sqrt(a.x * a.x + 1.0) / v_scale;\n"
                   "  c = vec4(a + texelFetch(map, ivec2(int(v_tag & 1u), 0), 0).xyz, b > 2.0 ? b : -b);\n"
                   "}\n");
  CHECK(result.shaded_pixels > 1000);
  CHECK(result.pixels_differ == 0);
}

TEST_CASE("what GLSL 3.30 lacks and softpipe has by extensions is asked for: mix of integers, offsets of blocks") {
  CHECK(shaded_alike("in vec3 v_color; out vec4 c;\n"
                     "void main() {\n"
                     "  ivec2 i = mix(ivec2(1, 2), ivec2(3, 4), greaterThan(v_color.xy, vec2(0.5)));\n"
                     "  c = vec4(i, mix(1u, 2u, v_color.z > 0.5), mix(false, true, v_color.x > 0.25));\n"
                     "}\n")
            .pixels_differ == 0);
  Bundle bundle = test::quad(6, 4);
  bundle.buffers = {{"Params", false, std::vector<std::byte>(48, std::byte{0x40})}};
  const ShaderSource source = shader(
      "layout(std140) uniform Params { layout(offset = 16) float a; layout(offset = 32) vec2 b; };\n"
      "in vec2 v_uv; out vec4 c; void main() { c = vec4(v_uv, a, b.y); }");
  DrawOptions options;
  options.capture_attributes = true;
  const Frame reference = make_gl_renderer(GlBackend::egl)->draw(bundle, source, options);
  CHECK(compare_frames(reference, shade_on_softpipe(bundle, source, reference, {}, kTimeLimit)).pixels_differ == 0);
}

TEST_CASE("pixels beside uncovered ones store to array elements as the others do") {
  // softpipe takes a store's index from the first pixel of a quad.
  CHECK(shaded_alike(kInputs +
                     "vec3 kept[8];\n"
                     "void main() {\n"
                     "  for (int i = 0; i < 8; i += 4)\n"
                     "    for (int k = 0; k < 4; ++k) kept[i + k] = v_color + float(i + k);\n"
                     "  precise vec3 sum = vec3(0.0);\n"
                     "  for (int i = 0; i < 8; ++i) { precise vec3 twice = sum * 2.0; sum = twice + kept[i]; }\n"
                     "  c = vec4(sum, 1.0);\n"
                     "}\n")
            .pixels_differ == 0);
}

TEST_CASE("built-ins of the fragment are the exact ones on softpipe too") {
  CHECK(shaded_alike(
            "out vec4 c; void main() { c = vec4(gl_FragCoord.zw, float(gl_PrimitiveID), gl_FrontFacing ? 1.0 : 0.0); }")
            .pixels_differ == 0);
  CHECK(shaded_alike("out vec4 c; void main() { c = vec4(gl_FragCoord.xy, 0, 1); }").pixels_differ == 0);
}

TEST_CASE("softpipe takes more triangles than its buffer textures hold") {
  const Bundle bundle = test::soup(test::Soup::small, 120, 70, 30000, 9);
  const ShaderSource source = shader("in vec3 v_color; out vec4 c; void main() { c = vec4(v_color, gl_FragCoord.w); }");
  DrawOptions options;
  options.capture_attributes = true;
  const Frame reference = make_gl_renderer(GlBackend::egl)->draw(bundle, source, options);
  const Frame frame = shade_on_softpipe(bundle, source, reference, {}, kTimeLimit);
  CHECK(compare_frames(reference, frame).pixels_differ == 0);
}

TEST_CASE("storage buffers and uniform blocks work on softpipe") {
  Bundle bundle = test::quad(6, 4);
  bundle.buffers = {{"Params", false, std::vector<std::byte>(16, std::byte{0x40})},
                    {"Table", true, std::vector<std::byte>(16, std::byte{0x41})}};
  const ShaderSource source = shader(
      "layout(std140) uniform Params { vec4 a; }; layout(std430) readonly buffer Table { float t[]; };\nin vec2 v_uv; "
      "out vec4 c;\n"
      "void main() { c = vec4(a.x, t[3], v_uv); }");
  DrawOptions options;
  options.capture_attributes = true;
  const Frame reference = make_gl_renderer(GlBackend::egl)->draw(bundle, source, options);
  const Frame frame = shade_on_softpipe(bundle, source, reference, {}, kTimeLimit);
  CHECK(compare_frames(reference, frame).pixels_differ == 0);
  CHECK(frame.color[1] > 12.0f);
}

TEST_CASE("derivatives are refused on softpipe by name") {
  const Bundle bundle = test::quad(4, 4);
  Frame empty;
  empty.width = empty.height = 4;
  CHECK(error_of([&] {
          shade_on_softpipe(bundle, shader("in vec2 v_uv;\nout vec4 c;\nvoid main() { c = vec4(fwidth(v_uv), 0, 1); }"),
                            empty, {}, kTimeLimit);
        }).find("test.frag:3: fwidth cannot be shaded on softpipe") == 0);
}

TEST_CASE("a frame without captured attributes cannot be shaded") {
  const Bundle bundle = test::quad(4, 4);
  const ShaderSource source = shader("in vec2 v_uv; out vec4 c; void main() { c = vec4(v_uv, 0, 1); }");
  const Frame frame = make_gl_renderer(GlBackend::egl)->draw(bundle, source, {});
  CHECK(error_of([&] { shade_on_softpipe(bundle, source, frame, {}, kTimeLimit); }) ==
        "softpipe: the frame to shade has no captured attribute v_uv.x");
}
