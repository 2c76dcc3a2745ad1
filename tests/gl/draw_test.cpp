// Drawing through EGL and OSMesa: what a frame holds.
#include <doctest/doctest.h>

#include <cstring>

#include "base/error.h"
#include "raster/gl/gl_renderer.h"
#include "tests/gl/test_bundles.h"

using namespace twinshade;

namespace {

const char* const kUvShader = R"(
in vec2 v_uv;
out vec4 color;
void main() { color = vec4(v_uv, 0.25, 1.0); }
)";

ShaderSource shader(const std::string& text) { return resolve_shader("test", text, "test.frag"); }

}  // namespace

TEST_CASE("a quad covers every pixel, with exact interpolation on both backends") {
  const Bundle bundle = test::quad(40, 24);
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa}) {
    const auto renderer = make_gl_renderer(backend);
    CAPTURE(renderer->name());
    DrawOptions options;
    options.capture_attributes = true;
    const Frame frame = renderer->draw(bundle, shader(kUvShader), options);
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
