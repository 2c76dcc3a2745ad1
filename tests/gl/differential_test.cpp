// The tiled renderer against every OpenGL route on random hard triangles: coverage, ids, depth and captured attributes.
#include <doctest/doctest.h>

#include "golden/compare_frames.h"
#include "raster/gl/gl_renderer.h"
#include "raster/tiled/tiled_renderer.h"
#include "tests/gl/test_shaders.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

TEST_CASE("cpu, egl and osmesa agree in every layer, with and without fused multiply-add") {
  GlEnvironment unfused, one_thread;
  unfused.host_fma = false;
  one_thread.threads = 1;
  const std::unique_ptr<Renderer> routes[] = {make_gl_renderer(GlBackend::egl), make_gl_renderer(GlBackend::osmesa),
                                              make_gl_renderer(GlBackend::egl, unfused),
                                              make_gl_renderer(GlBackend::osmesa, one_thread)};
  const ShaderSource source = test::shader("in vec4 v_value; out vec4 color; void main() { color = v_value; }");
  DrawOptions options;
  options.capture_attributes = true;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Bundle bundle = test::torture_bundle(64 + seed * 97 % 300, 50 + seed * 53 % 200, 50 << seed, 9000 + seed);
    const Frame cpu = draw_tiled(bundle, test::echo_module(), options);
    for (std::size_t route = 0; route < std::size(routes); ++route) {
      CAPTURE(seed);
      CAPTURE(route);
      const Frame gl = routes[route]->draw(bundle, source, options);
      CHECK(gl.attribute_names == cpu.attribute_names);
      const Comparison result = compare_frames(cpu, gl);
      CHECK(result.shaded_pixels > 1000);
      CHECK(result.coverage_differs == 0);
      CHECK(result.id_differs == 0);
      CHECK(result.depth_differs == 0);
      CHECK(result.attributes_differ == 0);
      CHECK(result.pixels_differ == 0);
    }
  }
}
