// Drawing through EGL and OSMesa: what a frame holds, for every kind of input, output and shader version.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "base/error.h"
#include "raster/gl/gl_renderer.h"
#include "tests/gl/test_bundles.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;
using test::error_of;
using test::shader;

namespace {

using Color = std::vector<float>;

Renderer& egl() {
  static const auto one = make_gl_renderer(GlBackend::egl);
  return *one;
}

DrawOptions in_mode(AttributeMode mode, bool capture = false) {
  DrawOptions options;
  options.attributes = mode;
  options.capture_attributes = capture;
  return options;
}

Color color_at(const Frame& frame, std::uint32_t x, std::uint32_t y) {
  const auto first = frame.color.begin() + std::ptrdiff_t(y * frame.width + x) * 4;
  return {first, first + 4};
}

std::uint32_t bits_of(float value) {
  std::uint32_t result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

// Adds an attribute that is the same at all vertices.
void constant(Bundle& bundle, const std::string& name, Scalar scalar, std::vector<float> value) {
  Attribute attribute{name, scalar, std::uint32_t(value.size()), {}};
  for (std::size_t v = 0; v < bundle.vertex_count(); ++v)
    attribute.values.insert(attribute.values.end(), value.begin(), value.end());
  bundle.attributes.push_back(attribute);
}

const AttributeMode kModes[] = {AttributeMode::exact, AttributeMode::native};

}  // namespace

TEST_CASE("a quad covers every pixel, with exact interpolation on both backends") {
  const Bundle bundle = test::quad(40, 24);
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa}) {
    const auto renderer = make_gl_renderer(backend);
    CAPTURE(renderer->name());
    const Frame frame =
        renderer->draw(bundle, shader("in vec2 v_uv; out vec4 color; void main() { color = vec4(v_uv, 0.25, 1.0); }"),
                       in_mode(AttributeMode::exact, true));
    REQUIRE(frame.width == 40);
    REQUIRE(frame.color.size() == 40 * 24 * 4);
    REQUIRE(frame.attribute_names == std::vector<std::string>{"v_uv.x", "v_uv.y"});
    for (std::uint32_t y = 0; y < 24; ++y)
      for (std::uint32_t x = 0; x < 40; ++x) {
        const std::size_t p = y * 40 + x;
        REQUIRE(frame.coverage[p] == 1);
        REQUIRE(frame.depth[p] == 0.5f);
        CHECK(frame.color[p * 4] == doctest::Approx((x + 0.5) / 40).epsilon(1e-6));
        CHECK(frame.color[p * 4 + 1] == doctest::Approx((y + 0.5) / 24).epsilon(1e-6));
        CHECK(frame.color[p * 4 + 2] == 0.25f);
        CHECK(frame.attributes[p] == frame.color[p * 4]);
        CHECK(frame.attributes[40 * 24 + p] == frame.color[p * 4 + 1]);
      }
    CHECK(frame.primitive_id[0 * 40 + 39] == 0);
    CHECK(frame.primitive_id[23 * 40 + 0] == 1);
  }
}

TEST_CASE("where nothing is drawn a frame is clear") {
  Bundle bundle = test::quad(8, 8);
  bundle.indices.clear();
  for (const AttributeMode mode : kModes) {
    const Frame frame = egl().draw(bundle, shader("out vec4 c; void main() { c = vec4(1.0); }"), in_mode(mode));
    for (std::size_t p = 0; p < 64; ++p) {
      CHECK(frame.coverage[p] == 0);
      CHECK(frame.primitive_id[p] == kNoPrimitive);
      CHECK(frame.depth[p] == 1.0f);
      CHECK(frame.color[p * 4 + 3] == 0.0f);
    }
  }
}

TEST_CASE("arrays, matrices and integers arrive element by element and column by column, in both modes") {
  Bundle bundle = test::quad(8, 8);
  for (int i = 0; i < 3; ++i)
    constant(bundle, "c[" + std::to_string(i) + "]", Scalar::f32, {float(i), float(i) + 0.5f});
  for (int i = 0; i < 2; ++i)
    constant(bundle, "m[" + std::to_string(i) + "]", Scalar::f32, {float(10 * i), float(10 * i + 1), 2});
  constant(bundle, "tags", Scalar::i32, {std::bit_cast<float>(0xfffffff0u), std::bit_cast<float>(5)});
  constant(bundle, "key", Scalar::u32, {std::bit_cast<float>(0xdeadbeefu)});
  const std::string declarations = "in vec2 c[3]; in mat2x3 m; flat in ivec2 tags; flat in uint key; out vec4 color;\n";
  for (const AttributeMode mode : kModes) {
    const Frame frame = egl().draw(
        bundle,
        shader(declarations +
               "void main() { color = vec4(c[2].y, m[1].y, float(tags.x), key == 0xdeadbeefu ? 1.0 : 0.0); }"),
        in_mode(mode, true));
    CHECK(color_at(frame, 3, 5) == Color{2.5f, 11, -16, 1});
    REQUIRE(frame.attribute_names == std::vector<std::string>{"c[0].x", "c[0].y", "c[1].x", "c[1].y", "c[2].x",
                                                              "c[2].y", "m[0].x", "m[0].y", "m[0].z", "m[1].x",
                                                              "m[1].y", "m[1].z", "tags.x", "tags.y", "key"});
    CHECK(frame.attributes[9 * 64 + 17] == 10.0f);
    CHECK(bits_of(frame.attributes[12 * 64 + 17]) == 0xfffffff0u);
    CHECK(bits_of(frame.attributes[14 * 64 + 17]) == 0xdeadbeefu);
  }
}

TEST_CASE("more inputs than vertex attributes are pulled") {
  Bundle bundle = test::quad(8, 8);
  std::string text, sum = "0.0";
  for (int i = 0; i < 27; ++i) {
    const std::string name = "a" + std::to_string(i);
    constant(bundle, name, Scalar::f32, {float(i), 1});
    text += "in vec2 " + name + ";\n";
    sum += " + " + name + ".x";
  }
  for (const AttributeMode mode : kModes) {
    const Frame frame =
        egl().draw(bundle, shader(text + "out vec4 c; void main() { c = vec4(" + sum + "); }"), in_mode(mode, true));
    CHECK(frame.color[0] == doctest::Approx(27 * 26 / 2));
    CHECK(frame.attribute_names.size() == 54);
    CHECK(frame.attributes[52 * 64] == doctest::Approx(26));
  }
}

TEST_CASE("flat inputs come from the last vertex") {
  Bundle bundle = test::quad(8, 8);
  bundle.attributes.push_back({"v_key", Scalar::f32, 1, {1, 2, 3, 4}});
  for (const AttributeMode mode : kModes) {
    const Frame frame =
        egl().draw(bundle, shader("flat in float v_key; out vec4 c; void main() { c = vec4(v_key); }"), in_mode(mode));
    CHECK(frame.color[(0 * 8 + 7) * 4] == 3);
    CHECK(frame.color[(7 * 8 + 0) * 4] == 4);
  }
}

TEST_CASE("the first output is the one at location 0; what it lacks is 0, integers keep their bits") {
  const Bundle bundle = test::quad(4, 4);
  const auto color = [&](const std::string& text, AttributeMode mode) {
    return color_at(egl().draw(bundle, shader(text), in_mode(mode)), 1, 1);
  };
  for (const AttributeMode mode : kModes) {
    CHECK(color("out vec2 c; void main() { c = vec2(1, 2); }", mode) == Color{1, 2, 0, 0});
    CHECK(color("out float c; void main() { c = 3.0; }", mode) == Color{3, 0, 0, 0});
    CHECK(color("layout(location = 1) out vec4 b; layout(location = 0) out vec4 a; void main() { a = vec4(1); b = "
                "vec4(2); }",
                mode) == Color{1, 1, 1, 1});
    CHECK(color("out vec4 b; layout(location = 0) out vec4 a; void main() { a = vec4(1); b = vec4(2); }", mode) ==
          Color{1, 1, 1, 1});
    CHECK(color("layout(location = 1) out vec4 b; out vec4 a; void main() { a = vec4(1); b = vec4(2); }", mode) ==
          Color{1, 1, 1, 1});
    CHECK(color("out vec4 a, b, c, d, e, f, g, h; void main() { a = vec4(5); h = a * 2.0; }", mode) ==
          Color{5, 5, 5, 5});
    CHECK(color("out vec4 a[2]; void main() { a[0] = vec4(5); a[1] = vec4(6); }", mode) == Color{5, 5, 5, 5});
    const Color integers = color("out uvec2 c; void main() { c = uvec2(0x7fc12345u, 1u); }", mode);
    CHECK(bits_of(integers[0]) == 0x7fc12345u);
    CHECK(bits_of(integers[1]) == 1u);
    CHECK(color("void main() {}", mode) == Color{0, 0, 0, 0});
  }
}

TEST_CASE("globals that start from an input see it") {
  const Bundle bundle = test::quad(4, 4);
  for (const AttributeMode mode : kModes) {
    const Frame frame =
        egl().draw(bundle,
                   shader("in vec2 v_uv;\nvec2 twice = v_uv * 2.0, table[2] = vec2[2](twice, v_uv);\nout vec4 c;\n"
                          "void main() { c = vec4(table[0], table[1]); }"),
                   in_mode(mode));
    CHECK(color_at(frame, 1, 2)[0] == doctest::Approx(0.75));
    CHECK(color_at(frame, 1, 2)[3] == doctest::Approx(0.625));
  }
}

TEST_CASE("discard and gl_FragDepth decide what a frame holds, captured attributes included") {
  Bundle bundle = test::quad(8, 8, 0.0f);
  const std::size_t vertices = bundle.vertex_count();
  for (std::size_t v = 0; v < vertices; ++v) {  // a second quad in front
    for (std::size_t c = 0; c < 4; ++c)
      bundle.clip_positions.push_back(c == 2 ? -0.5f : bundle.clip_positions[v * 4 + c]);
    for (std::size_t c = 0; c < 2; ++c)
      bundle.attributes[0].values.push_back(bundle.attributes[0].values[v * 2 + c] + 10);
  }
  for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) bundle.indices.push_back(4 + i);
  for (const AttributeMode mode : kModes) {
    const Frame cut = egl().draw(bundle,
                                 shader("in vec2 v_uv; out vec4 c; void main() { if (v_uv.x > 10.5 || v_uv.y < 0.5) "
                                        "discard; c = vec4(v_uv, 0, 1); }"),
                                 in_mode(mode, true));
    CHECK(cut.primitive_id[7 * 8 + 1] == 3);  // the front one
    CHECK(cut.primitive_id[7 * 8 + 6] == 1);  // through the front one's hole
    CHECK(cut.coverage[1 * 8 + 6] == 0);      // discarded by both
    CHECK(cut.attributes[7 * 8 + 6] == cut.color[(7 * 8 + 6) * 4]);
    CHECK(cut.attributes[7 * 8 + 1] == cut.color[(7 * 8 + 1) * 4]);
    const Frame swapped = egl().draw(bundle,
                                     shader("in vec2 v_uv; out vec4 c; void main() { gl_FragDepth = v_uv.x > 9.0 ? "
                                            "0.75 : 0.25; c = vec4(v_uv, 0, 1); }"),
                                     in_mode(mode, true));
    for (std::size_t p = 0; p < 64; ++p) {
      CHECK(swapped.depth[p] == 0.25f);
      CHECK(swapped.primitive_id[p] < 2);
      CHECK(swapped.attributes[p] == swapped.color[p * 4]);
    }
  }
}

TEST_CASE("front and back: gl_FrontFacing and culling") {
  Bundle bundle = test::quad(8, 8);
  bundle.indices = {0, 1, 2, 0, 3, 2};  // the second one clockwise
  const ShaderSource source = shader("out vec4 c; void main() { c = vec4(gl_FrontFacing ? 1.0 : -1.0); }");
  for (const AttributeMode mode : kModes) {
    bundle.cull_back_faces = false;
    const Frame both = egl().draw(bundle, source, in_mode(mode));
    CHECK(both.color[(0 * 8 + 7) * 4] == 1);
    CHECK(both.color[(7 * 8 + 0) * 4] == -1);
    bundle.cull_back_faces = true;
    const Frame front = egl().draw(bundle, source, in_mode(mode));
    CHECK(front.coverage[0 * 8 + 7] == 1);
    CHECK(front.coverage[7 * 8 + 0] == 0);
  }
}

TEST_CASE("shaders of versions 330, 300 es and 310 es are drawn") {
  const Bundle bundle = test::quad(4, 4);
  const std::string body = "in vec2 v_uv;\nout vec4 c;\nvoid main() { c = vec4(v_uv, float(__VERSION__), 1.0); }\n";
  for (const AttributeMode mode : kModes) {
    CHECK(color_at(egl().draw(bundle, shader("#version 330 core\n" + body), in_mode(mode)), 0, 0)[2] == 330);
    for (const char* version : {"300", "310"})
      CHECK(color_at(
                egl().draw(bundle, shader("#version " + std::string(version) + " es\nprecision highp float;\n" + body),
                           in_mode(mode)),
                0, 0)[2] == float(std::atoi(version)));
  }
}

TEST_CASE("derivatives are those of the pixel's own primitive") {
  const Bundle bundle = test::quad(16, 8);
  const ShaderSource source = shader("in vec2 v_uv; out vec4 c; void main() { c = vec4(dFdx(v_uv), dFdy(v_uv)); }");
  for (const AttributeMode mode : kModes) {
    const Frame frame = egl().draw(bundle, source, in_mode(mode));
    for (std::uint32_t y = 0; y < 8; ++y)
      for (std::uint32_t x = 0; x < 16; ++x) {
        const Color c = color_at(frame, x, y);
        CHECK(c[0] == doctest::Approx(1.0 / 16).epsilon(1e-4));
        CHECK(std::abs(c[1]) < 1e-6);
        CHECK(c[3] == doctest::Approx(1.0 / 8).epsilon(1e-4));
      }
  }
}

TEST_CASE("timings: medians over repetitions, with and without a depth prepass; the frame is the same") {
  const Bundle bundle = test::soup(test::Soup::large, 200, 100, 50, 2);
  const ShaderSource source = shader("in vec3 v_color; out vec4 c; void main() { c = vec4(v_color, 1); }");
  for (const AttributeMode mode : kModes) {
    DrawOptions options = in_mode(mode);
    const std::string once = frame_hash(egl().draw(bundle, source, options));
    options.repeat = 3;
    options.warmup = 1;
    for (const bool prepass : {false, true}) {
      options.depth_prepass = prepass;
      const Frame frame = egl().draw(bundle, source, options);
      REQUIRE(frame.milliseconds.size() == 1);
      CHECK(frame.milliseconds[0].first == "draw");
      CHECK(frame.milliseconds[0].second > 0);
      CHECK(frame_hash(frame) == once);
    }
  }
  DrawOptions prepass;
  prepass.depth_prepass = true;
  CHECK(error_of([&] {
          egl().draw(bundle, shader("out vec4 c; void main() { if (c.x > 1.0) discard; c = vec4(1); }"), prepass);
        }).find("a depth prepass cannot be drawn") != std::string::npos);
}

TEST_CASE("the largest and the smallest frame") {
  const ShaderSource source = shader("in vec2 v_uv; out vec4 c; void main() { c = vec4(v_uv, gl_FragCoord.xy); }");
  const Frame one = egl().draw(test::quad(1, 1), source, {});
  CHECK(color_at(one, 0, 0) == Color{0.5f, 0.5f, 0.5f, 0.5f});
  const Frame wide = egl().draw(test::quad(16384, 2), source, {});
  CHECK(color_at(wide, 16383, 1)[2] == 16383.5f);
  CHECK(color_at(wide, 16383, 1)[0] == doctest::Approx(16383.5 / 16384));
  CHECK(error_of([&] { egl().draw(test::quad(16385, 2), source, {}); }).find("16385x2") != std::string::npos);
}
