// The shaders that OpenGL is timed with draw the picture that the exact ones draw, as nearly as the driver filters.
#include <doctest/doctest.h>

#include <cmath>

#include "lighting/bake.h"
#include "lighting/driver_source.h"
#include "lighting/environment_light.h"
#include "lighting/visibility_bundle.h"
#include "raster/gl/gl_renderer.h"

using namespace twinshade;

namespace {

// Mean difference of all channels over their mean.
double relative_difference(const Frame& a, const Frame& b) {
  double sum = 0, difference = 0;
  for (std::size_t i = 0; i < a.color.size(); ++i) {
    sum += std::fabs(a.color[i]);
    difference += std::fabs(double(a.color[i]) - double(b.color[i]));
  }
  return difference / sum;
}

FrameOptions small_frame(const Scene& scene) {
  FrameOptions options;
  options.width = 96, options.height = 60;
  options.camera = scene.camera;
  return options;
}

}  // namespace

TEST_CASE("driver sources of bases differ from the written-out ones by the filter's rounding") {
  const Scene scene = load_scene("spheres");
  const Environment environment = load_environment("sky", false);
  BakeOptions bake;
  bake.lightmap_size = 32, bake.rays = 16, bake.probe_rays = 16, bake.volume = {4, 3, 4};
  bake.show_progress = bake.use_cache = false;
  const LightBake lights[] = {bake_light(scene, environment, bake), bake_volume(scene, environment, bake)};
  const std::vector<LitTechnique> wanted = {{&find_technique("h4"), CoefficientStorage::lightmap},
                                            {&find_technique("sh3"), CoefficientStorage::lightmap},
                                            {&find_technique("sh3"), CoefficientStorage::volume},
                                            {&find_technique("ad_cos2"), CoefficientStorage::volume}};
  const Bundle bundle = make_bundle(scene, lights, wanted, small_frame(scene));
  const auto egl = make_gl_renderer(GlBackend::egl);
  DrawOptions options;
  options.attributes = AttributeMode::native;
  for (const LitTechnique& lit : wanted) {
    const ShaderSource exact = technique_source(*lit.technique, lit.storage);
    CAPTURE(exact.name);
    const ShaderSource driver = driver_source(*lit.technique, lit.storage, sphere_maps().front());
    CHECK(driver.text.find("texelFetch") == std::string::npos);
    CHECK(relative_difference(egl->draw(bundle, exact, options), egl->draw(bundle, driver, options)) < 1e-4);
  }
}

TEST_CASE("driver sources of tables on sphere maps differ by no more than the edges of a cube's faces") {
  const Scene scene = load_scene("spheres");
  VisibilityOptions bake;
  bake.lightmap_size = 32, bake.rays = 64;
  bake.show_progress = bake.use_cache = false;
  const VisibilityBake bakes[] = {bake_visibility(scene, bake)};
  const std::vector<LitTechnique> wanted = {{&find_technique("unc3"), CoefficientStorage::lightmap}};
  VisibilityLighting lighting;
  for (const SphereMapInfo& map : sphere_maps()) lighting.maps.push_back(&map);
  Bundle bundle = make_bundle(scene, std::span<const LightBake>(), wanted, small_frame(scene));
  add_visibility(bundle, scene, bakes, environment_radiance(load_environment("sky", false), 6), wanted, lighting);
  const auto egl = make_gl_renderer(GlBackend::egl);
  DrawOptions options;
  options.attributes = AttributeMode::native;
  for (const SphereMapInfo& map : sphere_maps()) {
    CAPTURE(map.name);
    const ShaderSource exact = visibility_source(*wanted[0].technique, wanted[0].storage, map);
    const ShaderSource driver = driver_source(*wanted[0].technique, wanted[0].storage, map);
    CHECK(driver.text.find("texelFetch") == std::string::npos);
    CHECK(relative_difference(egl->draw(bundle, exact, options), egl->draw(bundle, driver, options)) <
          (map.name == "cube" ? 3e-3 : 1e-4));
  }
}
