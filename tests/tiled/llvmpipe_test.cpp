// The tiled renderer against llvmpipe on random hard scenes: no pixel may differ in any bit.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "golden/compare_frames.h"
#include "raster/gl/gl_renderer.h"
#include "raster/tiled/tiled_renderer.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

const char* kEcho =
    "in vec4 v_value;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = v_value; }\n";
const char* kBuiltIns =
    "in vec4 v_value;\n"
    "flat in uint v_key;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() {\n"
    "  color = vec4(float(gl_PrimitiveID), float(v_key), gl_FrontFacing ? 1.0 : 0.0, gl_FragCoord.w);\n"
    "}\n";
const char* kDiscard =
    "in vec4 v_value;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() {\n"
    "  if (v_value.x < 0.5) discard;\n"
    "  color = v_value;\n"
    "}\n";
const char* kFragDepth =
    "in vec4 v_value;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() {\n"
    "  gl_FragDepth = v_value.y;\n"
    "  color = v_value;\n"
    "}\n";

struct Twin {
  const char* glsl;
  const ShaderModule& module;
};

std::string describe(const Comparison& c) {
  char line[400];
  std::snprintf(line, sizeof line, "coverage %llu id %llu depth %llu pixels %llu of %llu",
                static_cast<unsigned long long>(c.coverage_differs), static_cast<unsigned long long>(c.id_differs),
                static_cast<unsigned long long>(c.depth_differs), static_cast<unsigned long long>(c.pixels_differ),
                static_cast<unsigned long long>(c.shaded_pixels));
  std::string text = line;
  if (c.first) {
    std::snprintf(line, sizeof line, "; first: %s at %u, %u component %u: %a (%08x) against %a (%08x)",
                  c.first->layer.c_str(), c.first->x, c.first->y, c.first->component, c.first->a, c.first->a_bits,
                  c.first->b, c.first->b_bits);
    text += line;
  }
  return text;
}

// More scenes for a longer hunt.
int scenes(int usual) {
  const char* factor = std::getenv("TWINSHADE_TEST_FACTOR");
  return usual * (factor ? std::atoi(factor) : 1);
}

}  // namespace

TEST_CASE("random hard scenes are llvmpipe's to the last bit") {
  const auto egl = make_gl_renderer(GlBackend::egl);
  const Twin twins[] = {{kEcho, test::echo_module()},
                        {kBuiltIns, test::built_ins_module()},
                        {kDiscard, test::discard_module()},
                        {kFragDepth, test::frag_depth_module()}};
  for (int seed = 1; seed <= scenes(6); ++seed) {
    const std::uint32_t width = 100 + 61 * std::uint32_t(seed % 9), height = 90 + 37 * std::uint32_t(seed % 7);
    Bundle bundle = test::torture_bundle(width, height, 40 << (seed % 6), 1000 + std::uint64_t(seed));
    bundle.cull_back_faces = seed % 5 == 4;
    const Twin& twin = twins[seed % 4];
    CAPTURE(seed);
    CAPTURE(twin.module.name);
    const ShaderSource source = resolve_shader(twin.module.name, twin.glsl, "test.frag");
    const Frame cpu = draw_tiled(bundle, twin.module, {});
    const Frame gl = egl->draw(bundle, source, {});
    const Comparison comparison = compare_frames(cpu, gl);
    CHECK(comparison.shaded_pixels > 1000);
    CHECK_MESSAGE(comparison.equal(), describe(comparison));
  }
}

TEST_CASE("without host FMA llvmpipe still draws the same") {
  GlEnvironment environment;
  environment.host_fma = false;
  const auto egl = make_gl_renderer(GlBackend::egl, environment);
  const Bundle bundle = test::torture_bundle(800, 450, 3000, 77);
  const Comparison comparison = compare_frames(draw_tiled(bundle, test::echo_module(), {}),
                                               egl->draw(bundle, resolve_shader("echo", kEcho, "test.frag"), {}));
  CHECK_MESSAGE(comparison.equal(), describe(comparison));
}
