#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "lighting/bake.h"
#include "lighting/bake_cache.h"
#include "lighting/projection.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"
#include "lighting/volume_gather.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

using std::numbers::pi;

BakeOptions small_volume() {
  BakeOptions options;
  options.volume = {4, 3, 4};
  options.probe_rays = 64;
  options.rays = 32;
  options.lightmap_size = 32;
  options.use_cache = false;
  options.show_progress = false;
  return options;
}

// A box of side 1 around `centre`, seen from outside.
void add_box(Scene& scene, const glm::vec3& centre) {
  const glm::vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-0.5f, 0.5f}) {
      const glm::vec3 a = axes[(axis + 1) % 3], b = axes[(axis + 2) % 3];
      const glm::vec3 corner = centre + axes[axis] * side - a * 0.5f - b * 0.5f;
      if (side > 0)
        add_rectangle(scene, corner, a, b, {0, 0}, 0.1f);
      else
        add_rectangle(scene, corner, b, a, {0, 0}, 0.1f);
    }
}

// Irradiance at a probe for a few normals, by the shader of `basis`.
std::vector<double> probe_irradiance(const LightBake& volume, std::size_t probe, const char* basis,
                                     std::span<const glm::dvec3> normals) {
  const TechniqueInfo& technique = find_technique(basis);
  const float* from = volume.sh.data() + probe * volume.radiance_count * 3;
  std::vector<double> radiance(from, from + volume.radiance_count * 3), coefficients(technique.count * 3);
  radiance.resize(kMostRadianceCount * 3);
  Projector(technique, kMostRadianceCount).project(radiance.data(), coefficients.data());
  return reconstruct(technique, coefficients, normals);
}

TEST_CASE("probes: each in the middle of its share of the bounding box; flat scenes are given depth") {
  Scene scene = furnace_scene(0.5f);
  const ProbeGrid grid = probe_grid(scene, {4, 2, 1}, 1e30f);
  CHECK(grid.count() == 8);
  CHECK(grid.position(0) == glm::vec3(-0.75f, -0.5f, 0));
  CHECK(grid.position(3) == glm::vec3(0.75f, -0.5f, 0));
  CHECK(grid.position(4) == glm::vec3(-0.75f, 0.5f, 0));
  CHECK(grid.scale == glm::vec3(2, 1, 0));
  const ProbeGrid flat = probe_grid(floor_scene(), {2, 2, 2}, 1e30f);
  CHECK(flat.position(0).y < 0);
  CHECK(flat.position(2).y > 0);
  scene.positions[0] = glm::vec3(NAN, 1e20f, 0);
  CHECK(probe_grid(scene, {4, 2, 1}, 1e3f).position(0) == grid.position(0));
}

TEST_CASE("a constant sky without a scene to shade it: pi L for every basis that has constants") {
  Scene scene = scene_with_albedo(0.5f);  // two far specks that span the box
  add_rectangle(scene, {-1, -1, -1}, {1e-6f, 0, 0}, {0, 0, -1e-6f}, {0, 0}, 0.5f);
  add_rectangle(scene, {1, 1, 1}, {1e-6f, 0, 0}, {0, 0, -1e-6f}, {0.5f, 0.5f}, 0.5f);
  const LightBake volume = bake_volume(scene, uniform_environment(0.5f), small_volume());
  REQUIRE(volume.sh.size() == 48u * volume.radiance_count * 3);
  const std::vector<glm::dvec3> normals = sphere_quadrature(-1, 4).directions;
  const Quadrature sphere = icosahedral_quadrature(4);
  const std::vector<double> one(sphere.weights.size() * 3, 1.0);
  int checked = 0;
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis || !can_read(basis, CoefficientStorage::volume)) continue;
    if (basis.linear || basis.projection == Projection::luma_chroma) {  // does 1 come back?
      const std::vector<double> fitted = SampleProjector(basis, sphere.directions, sphere.weights).project(one, {});
      bool constant = true;
      for (const double value : reconstruct(basis, fitted, normals)) constant = constant && std::abs(value - 1) < 1e-6;
      if (!constant) continue;
    }
    CAPTURE(std::string(basis.name));
    ++checked;
    for (const std::size_t probe : {0u, 21u, 47u})
      for (const double e : probe_irradiance(volume, probe, std::string(basis.name).c_str(), normals))
        CHECK(e == doctest::Approx(0.5 * pi).epsilon(1e-4));
  }
  CHECK(checked >= 15);
}

TEST_CASE("a floor reflects its share of the sky into the probes above it") {
  const LightBake volume = bake_volume(floor_scene(40), uniform_environment(1), small_volume());
  // Just above the middle of a wide floor of albedo 1/2: radiance 1 from above, 1/2 from below
  std::size_t probe = 1 + 4 * (2 + 3 * 1);
  const glm::dvec3 normals[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}};
  const std::vector<double> e = probe_irradiance(volume, probe, "sh5", normals);
  CHECK(e[0] == doctest::Approx(pi).epsilon(0.03));
  CHECK(e[3] == doctest::Approx(pi / 2).epsilon(0.06));
  CHECK(e[6] == doctest::Approx(pi * 0.75).epsilon(0.06));
}

TEST_CASE("a probe behind an open sheet takes its light from those before it") {
  // Two layers of probes, of which the lower ones see the floor's back in just under half of their rays
  BakeOptions options = small_volume();
  options.volume = {3, 2, 3};
  const LightBake volume = bake_volume(floor_scene(), uniform_environment(1), options);
  const glm::dvec3 normals[] = {{0, 1, 0}};
  for (const std::size_t above : {3u, 4u, 5u, 10u})
    for (const std::size_t probe : {above - 3, above})
      CHECK(probe_irradiance(volume, probe, "sh5", normals)[0] == doctest::Approx(pi).epsilon(0.03));
}

TEST_CASE("a probe inside of a box takes its light from those around it") {
  Scene scene = furnace_scene(0);
  scene.indices.erase(scene.indices.begin() + 6, scene.indices.begin() + 12);  // no ceiling
  scene.triangle_materials.resize(scene.indices.size() / 3);
  add_box(scene, {0, 0, 0});
  BakeOptions options = small_volume();
  options.volume = {3, 3, 3};
  const LightBake volume = bake_volume(scene, uniform_environment(1), options);
  const std::size_t middle = 13, stride = std::size_t(volume.radiance_count) * 3;
  for (std::size_t k = 0; k < stride; ++k) {
    double sum = 0;
    for (const std::size_t beside : {12u, 14u, 10u, 16u, 4u, 22u}) sum += double(volume.sh[beside * stride + k]);
    CHECK(volume.sh[middle * stride + k] == doctest::Approx(sum / 6).epsilon(1e-5));
  }
  CHECK(volume.sh[middle * stride] > 0.1f);
}

TEST_CASE("a volume has the same bits at any number of threads; seed, rays and size change it") {
  Scene scene = furnace_scene(0.6f);
  scene.indices.erase(scene.indices.begin() + 6, scene.indices.begin() + 12);
  scene.triangle_materials.resize(10);
  Environment environment = uniform_environment(0.5f, 64);
  environment.radiance[3 * 64 + 9] = glm::vec3(700, 600, 500);
  const auto hash = [&](const BakeOptions& options) { return bake_volume(scene, environment, options).hash; };
  set_thread_count(1);
  const std::string one = hash(small_volume());
  for (const int threads : {2, 7}) {
    set_thread_count(threads);
    CHECK(hash(small_volume()) == one);
  }
  set_thread_count(0);
  for (int change = 0; change < 4; ++change) {
    BakeOptions options = small_volume();
    if (change == 0) options.seed = 2;
    if (change == 1) options.probe_rays = 65;
    if (change == 2) options.volume.y = 4;
    if (change == 3) options.bounce = false;
    CHECK(hash(options) != one);
  }
}

TEST_CASE("a serialised volume comes back whole") {
  const LightBake volume = bake_volume(furnace_scene(0.5f), uniform_environment(1), small_volume());
  const std::optional<LightBake> back = deserialize_bake(serialize_bake(volume));
  REQUIRE(back.has_value());
  CHECK(back->storage == CoefficientStorage::volume);
  CHECK(back->sh == volume.sh);
  CHECK(back->volume == volume.volume);
  CHECK(back->volume_origin == volume.volume_origin);
  CHECK(back->volume_scale == volume.volume_scale);
  CHECK(back->radiance_count == volume.radiance_count);
}

TEST_CASE("procedural scenes: a smooth volume, finite where positions are not") {
  Scene scene = floor_scene();
  scene.procedural_coefficients = true;
  scene.positions[1] = glm::vec3(NAN, INFINITY, 1e30f);
  const LightBake volume = bake_volume(scene, uniform_environment(1), small_volume());
  for (const float value : volume.sh) CHECK(std::abs(value) < 3);
  CHECK(volume.hash == bake_volume(scene, uniform_environment(2), small_volume()).hash);
}

TEST_CASE("a bundle may have light from several storages, each noted") {
  const Scene scene = floor_scene();
  const Environment sky = uniform_environment(1);
  BakeOptions options = small_volume();
  std::vector<LightBake> lights{bake_volume(scene, sky, options), bake_light(scene, sky, options)};
  options.per_vertex = true;
  lights.push_back(bake_light(scene, sky, options));
  const TechniqueInfo &sh3 = find_technique("sh3"), &h4 = find_technique("h4");
  const Bundle bundle = make_bundle(
      scene, lights,
      {{&h4, CoefficientStorage::lightmap}, {&sh3, CoefficientStorage::vertex}, {&sh3, CoefficientStorage::volume}},
      FrameOptions());
  validate(bundle, "test");
  CHECK(*bundle.find_note("coefficients") == "lightmap vertex volume");
  CHECK(*bundle.find_note("techniques") == "h4 sh3");
  CHECK(*bundle.find_note("volume") == "4x3x4");
  CHECK(bundle.find_note("volume_hash") != nullptr);
  CHECK(bundle.find_note("vertex_bake_hash") != nullptr);
  CHECK(bundle.find_texture("coefficients_h4") != nullptr);
  CHECK(bundle.find_texture("coefficients_sh3") == nullptr);
  CHECK(bundle.find_attribute("coefficients_sh3[8]") != nullptr);
  const Texture* texture = bundle.find_texture("volume_sh3");
  REQUIRE(texture != nullptr);
  CHECK(texture->width == 4);
  CHECK(texture->height == 12);
  CHECK(texture->layers == 9);
  for (const char* name : {"v_normal", "v_tangent", "v_position"}) CHECK(bundle.find_attribute(name) != nullptr);
  for (const char* name : {"volume_origin", "volume_scale", "volume_size"}) CHECK(bundle.find_uniform(name) != nullptr);
}

TEST_CASE("volumes out of range are refused") {
  for (int change = 0; change < 4; ++change) {
    BakeOptions options = small_volume();
    if (change == 0) options.volume.x = 0;
    if (change == 1) options.volume.z = 257;
    if (change == 2) options.volume = {1, 200, 100};
    if (change == 3) options.probe_rays = 0;
    CHECK_THROWS_AS(bake_volume(floor_scene(), uniform_environment(1), options), UserError);
  }
}

}  // namespace
}  // namespace twinshade
