// Frames that must be the same bits: EGL and OSMesa, with and without fused multiply-add, on any number of threads.
#include <doctest/doctest.h>

#include <map>

#include "golden/compare_frames.h"
#include "raster/gl/gl_renderer.h"
#include "tests/gl/test_bundles.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;
using test::shader;
using test::Soup;

namespace {

const char* const kSoupShader = R"(
in vec3 v_color;
in float v_scale;
flat in uint v_tag;
out vec4 color;
void main() {
  precise vec3 lit = v_color * v_scale + v_color.zxy;
  color = vec4(lit, float(v_tag >> 8) * (gl_FrontFacing ? 1.0 : -1.0) + gl_FragCoord.w);
})";

const std::map<Soup, const char*> kSoups = {
    {Soup::small, "small"},     {Soup::large, "large"},
    {Soup::slivers, "slivers"}, {Soup::near_crossing, "crossing the near plane"},
    {Soup::huge, "huge"},       {Soup::reversed_and_empty, "reversed and empty"}};

void check_equal(const Frame& a, const Frame& b) {
  const Comparison result = compare_frames(a, b);
  CHECK(result.shaded_pixels > 0);
  CHECK(result.coverage_differs == 0);
  CHECK(result.id_differs == 0);
  CHECK(result.depth_differs == 0);
  CHECK(result.attributes_differ == 0);
  CHECK(result.pixels_differ == 0);
  CHECK(frame_hash(a) == frame_hash(b));
}

}  // namespace

TEST_CASE("EGL, OSMesa, no fused multiply-add, one thread, division in integers: the same bits with exact attributes") {
  GlEnvironment unfused, one_thread, written_out;
  unfused.host_fma = false;
  one_thread.threads = 1;
  written_out.written_out = true;
  const auto egl = make_gl_renderer(GlBackend::egl);
  const std::vector<std::unique_ptr<Renderer>> others = [&] {
    std::vector<std::unique_ptr<Renderer>> list;
    list.push_back(make_gl_renderer(GlBackend::osmesa));
    list.push_back(make_gl_renderer(GlBackend::egl, unfused));
    list.push_back(make_gl_renderer(GlBackend::osmesa, unfused));
    list.push_back(make_gl_renderer(GlBackend::egl, one_thread));
    list.push_back(make_gl_renderer(GlBackend::egl, written_out));
    return list;
  }();
  DrawOptions options;
  options.capture_attributes = true;
  for (const auto& soup : kSoups) {
    CAPTURE(soup.second);
    const Bundle bundle = test::soup(soup.first, 300, 200, 400, 7);
    const Frame reference = egl->draw(bundle, shader(kSoupShader), options);
    for (const auto& other : others) check_equal(reference, other->draw(bundle, shader(kSoupShader), options));
  }
}

TEST_CASE("what was captured is what was shaded") {
  const Bundle bundle = test::soup(Soup::large, 200, 150, 60, 3);
  const auto renderer = make_gl_renderer(GlBackend::egl);
  DrawOptions options;
  options.capture_attributes = true;
  const ShaderSource source =
      shader("in vec3 v_color; in float v_scale; out vec4 c; void main() { c = vec4(v_color, v_scale); }");
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native}) {
    options.attributes = mode;
    const Frame frame = renderer->draw(bundle, source, options);
    REQUIRE(frame.attribute_names == std::vector<std::string>{"v_color.x", "v_color.y", "v_color.z", "v_scale"});
    const std::size_t pixels = 200 * 150;
    std::size_t covered = 0;
    for (std::size_t p = 0; p < pixels; ++p)
      for (std::size_t c = 0; c < 4; ++c)
        if (frame.coverage[p]) {
          ++covered;
          REQUIRE(frame.attributes[c * pixels + p] == frame.color[p * 4 + c]);
        }
    CHECK(covered > 4 * 1000);
  }
}

TEST_CASE("native attributes are close to exact ones") {
  const Bundle bundle = test::soup(Soup::small, 200, 150, 300, 5);
  const auto renderer = make_gl_renderer(GlBackend::egl);
  const ShaderSource source = shader("in vec3 v_color; out vec4 c; void main() { c = vec4(v_color, gl_FragCoord.w); }");
  DrawOptions native;
  native.attributes = AttributeMode::native;
  const Frame a = renderer->draw(bundle, source, {}), b = renderer->draw(bundle, source, native);
  const Comparison result = compare_frames(a, b);
  CHECK(result.coverage_differs == 0);
  CHECK(result.shaded_pixels > 500);
  for (std::size_t i = 0; i < a.color.size(); ++i) REQUIRE(a.color[i] == doctest::Approx(b.color[i]).epsilon(1e-3));
}
