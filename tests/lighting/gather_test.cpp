#include "lighting/gather.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "lighting/direction_sets.h"
#include "lighting/environment_sampler.h"
#include "lighting/radiance_basis.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

using std::numbers::pi;

BakeOptions options(std::uint32_t size, std::uint32_t rays, bool bounce) {
  BakeOptions o;
  o.lightmap_size = size;
  o.rays = rays;
  o.bounce = bounce;
  o.use_cache = false;
  o.show_progress = false;
  return o;
}

float sh(const GatheredLight& light, std::size_t cell, int k, int channel = 0) {
  return light.sh[cell * kRadianceCount * 3 + k * 3 + channel];
}

// Mean over the cells whose integer coordinates pass `chosen`.
template <class Chosen>
double mean_irradiance(const GatheredLight& light, const Chosen& chosen) {
  double sum = 0;
  int count = 0;
  for (std::uint32_t cell = 0; cell < light.width * light.height; ++cell) {
    if (!chosen(cell % light.width, cell / light.width)) continue;
    sum += light.irradiance[cell * 3];
    ++count;
  }
  return sum / count;
}

TEST_CASE("directions are uniform on the hemisphere: one in each band and each sector") {
  const DirectionSets sets(64, 5);
  for (std::uint32_t set = 0; set < std::min(sets.count(), 50u); ++set) {
    int sector_count[64] = {};
    for (int ray = 0; ray < 64; ++ray) {
      const glm::dvec3& d = sets.directions(set)[ray];
      CHECK(glm::length(d) == doctest::Approx(1).epsilon(1e-14));
      CHECK(int(d.z * 64) == ray);
      const double angle = std::atan2(d.y, d.x) / (2 * pi);
      ++sector_count[int((angle < 0 ? angle + 1 : angle) * 64)];
    }
    for (const int count : sector_count) CHECK(count == 1);
  }
}

TEST_CASE("environment: rest and bright pixels add up to the whole, and the sun's solid angle is exact") {
  Environment environment = uniform_environment(0.25f, 64);
  environment.radiance[10 * 64 + 20] = glm::vec3(900, 800, 300);
  environment.radiance[10 * 64 + 21] = glm::vec3(100, 800, 900);
  const EnvironmentSampler sampler(environment);
  REQUIRE(sampler.bright_count() == 2);
  glm::dvec3 bright(0);
  constexpr int kSamples = 4096;
  for (int i = 0; i < kSamples; ++i) {
    const EnvironmentSampler::Sample sample = sampler.bright((i + 0.5) / kSamples, 0.5, 0.5);
    CHECK(glm::length(sample.direction) == doctest::Approx(1).epsilon(1e-14));
    bright += sample.radiance / double(kSamples);
    const glm::dvec3 a = environment.pixel_direction(20, 10), b = environment.pixel_direction(21, 10);
    CHECK(std::max(glm::dot(sample.direction, a), glm::dot(sample.direction, b)) > 0.9999);
  }
  const double omega = 2 * pi / 64 * (std::cos(pi * 10 / 32) - std::cos(pi * 11 / 32));
  glm::dvec3 rest(0), whole(0);
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < 2 * kSteps; ++k) {
      const double z = -1 + 2 * (i + 0.5) / kSteps, angle = pi * (k + 0.5) / kSteps, r = std::sqrt(1 - z * z);
      rest += glm::dvec3(sampler.rest(glm::vec3(r * std::cos(angle), z, r * std::sin(angle)))) *
              (4 * pi / (2.0 * kSteps * kSteps));
    }
  for (int c = 0; c < 3; ++c)
    whole[c] = 0.25 * (4 * pi - 2 * omega) + omega * (environment.radiance[660][c] + environment.radiance[661][c]);
  for (int c = 0; c < 3; ++c) CHECK(rest[c] + bright[c] == doctest::Approx(whole[c]).epsilon(2e-3));
}

TEST_CASE("rays see as much light of a picture whose pixels all differ as the pixels give, to a thousandth") {
  Environment environment;
  environment.width = 128, environment.height = 64;
  environment.radiance.resize(128 * 64);
  std::mt19937 random(1);
  for (glm::vec3& pixel : environment.radiance)
    for (int c = 0; c < 3; ++c) pixel[c] = float(std::pow(random() * 0x1p-32, 2.0));  // none is bright
  const EnvironmentSampler sampler(environment);
  REQUIRE(!sampler.has_bright());
  for (const glm::dvec3& normal : {glm::dvec3(0, 0.8, 0.6), glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0, -0.8)}) {
    glm::dvec3 pixels(0), seen(0);
    const auto add = [&](std::uint32_t width, std::uint32_t height, glm::dvec3& sum, const auto& radiance) {
      for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
          const double top = std::cos(pi * y / height), bottom = std::cos(pi * (y + 1) / height);
          const double sine = (top + bottom) / 2, angle = pi - 2 * pi * (x + 0.5) / width;
          const double across = std::sqrt(1 - sine * sine);
          const glm::dvec3 d(std::sin(angle) * across, sine, std::cos(angle) * across);
          const double cosine = std::max(0.0, glm::dot(d, normal));
          sum += radiance(x, y, d) * (cosine * (top - bottom) * 2 * pi / width);
        }
    };
    // Pixels as they stand, cut to pieces for the cosine; what rays find in as many directions.
    add(1024, 512, pixels, [&](std::uint32_t x, std::uint32_t y, const glm::dvec3&) {
      return glm::dvec3(environment.radiance[y / 8 * 128 + x / 8]);
    });
    add(1024, 512, seen,
        [&](std::uint32_t, std::uint32_t, const glm::dvec3& d) { return glm::dvec3(sampler.rest(glm::vec3(d))); });
    for (int c = 0; c < 3; ++c) {
      CAPTURE(pixels[c]);
      CHECK(std::abs(seen[c] / pixels[c] - 1) < 0.001);
    }
  }
}

TEST_CASE("a constant sky over open ground: the projected hemisphere in closed form, irradiance pi") {
  const GatheredLight light = gather_light(floor_scene(), uniform_environment(1), options(8, 1024, true));
  REQUIRE(light.width == 8);
  for (std::size_t cell = 0; cell < 64; ++cell) {
    CHECK(light.irradiance[cell * 3] == doctest::Approx(pi).epsilon(1e-3));
    for (int k = 0; k < kRadianceCount; ++k) {
      const double expected = k == 0    ? std::sqrt(pi)
                              : k == 2  ? std::sqrt(3 * pi) / 2
                              : k == 12 ? -2 * pi * std::sqrt(7 / (4 * pi)) / 8
                                        : 0;
      CAPTURE(k);
      CHECK(std::abs(sh(light, cell, k) - expected) < 0.02);
    }
  }
}

TEST_CASE("a wall that hides half of the sky halves the irradiance beside it") {
  // The wall stands on the floor's edge z = -1, so high and wide that what it leaves of its half does not count.
  Scene scene = scene_with_albedo(0);
  add_rectangle(scene, {-0.01f, 0, -0.98f}, {0.02f, 0, 0}, {0, 0, -0.02f}, {0, 0}, 0.5f);
  add_rectangle(scene, {-4000, -1, -1}, {8000, 0, 0}, {0, 4000, 0}, {0.6f, 0.6f}, 0.3f);
  const GatheredLight light = gather_light(scene, uniform_environment(1), options(32, 1024, false));
  for (std::uint32_t y = 8; y < 16; ++y)
    for (std::uint32_t x = 0; x < 16; ++x)
      CHECK(light.irradiance[(y * 32 + x) * 3] == doctest::Approx(pi / 2).epsilon(0.03));
  const double mean = mean_irradiance(light, [](auto x, auto y) { return x < 16 && y >= 8 && y < 16; });
  CHECK(mean == doctest::Approx(pi / 2).epsilon(4e-3));
}

TEST_CASE("the sun obeys the cosine law with its exact solid angle, and its shadow is black") {
  Environment environment = uniform_environment(0, 256);
  environment.radiance[20 * 256 + 37] = glm::vec3(3e4f);
  const glm::dvec3 sun = environment.pixel_direction(37, 20);
  const double omega = 2 * pi / 256 * (std::cos(pi * 20 / 128) - std::cos(pi * 21 / 128));
  const GatheredLight open = gather_light(floor_scene(), environment, options(4, 256, false));
  for (int cell = 0; cell < 16; ++cell)
    CHECK(open.irradiance[cell * 3] == doctest::Approx(3e4 * omega * sun.y).epsilon(2e-3));

  // The projection is the impulse's: L omega Y(sun), here in the floor's frame (x, -z, y)
  const glm::dvec3 local(sun.x, -sun.z, sun.y);
  const std::vector<double> y = radiance_basis({&local, 1});
  for (int k = 0; k < kRadianceCount; ++k) CHECK(std::abs(sh(open, 5, k) - 3e4 * omega * y[k]) < 0.01 * 3e4 * omega);

  Scene roofed = floor_scene(0.1f);
  add_rectangle(roofed, {-50, 1, -50}, {100, 0, 0}, {0, 0, 100}, {2, 2}, 0.1f);
  const GatheredLight shadow = gather_light(roofed, environment, options(4, 256, false));
  for (int cell = 0; cell < 16; ++cell) CHECK(shadow.irradiance[cell * 3] == 0);
}

TEST_CASE("one bounce in a closed room is the albedo's share of the direct light") {
  // The room's ceiling is missing: the sky lights it. With albedo a and E the direct irradiance of what a texel sees,
  // the bounce adds the mean over the cosine-weighted hemisphere of a E; half the albedo brings half of it.
  Scene room = furnace_scene(0.8f), darker = furnace_scene(0.4f);
  for (Scene* scene : {&room, &darker}) {
    scene->indices.erase(scene->indices.begin() + 6, scene->indices.begin() + 12);
    scene->triangle_materials.resize(10);
  }
  const Environment sky = uniform_environment(1);
  const GatheredLight direct = gather_light(room, sky, options(48, 256, false));
  const GatheredLight bright = gather_light(room, sky, options(48, 256, true));
  const GatheredLight dark = gather_light(darker, sky, options(48, 256, true));
  double added_bright = 0, added_dark = 0;
  for (std::size_t cell = 0; cell < 48 * 48; ++cell) {
    added_bright += sh(bright, cell, 0) - sh(direct, cell, 0);
    added_dark += sh(dark, cell, 0) - sh(direct, cell, 0);
  }
  CHECK(added_bright > 0);
  CHECK(added_dark == doctest::Approx(added_bright / 2).epsilon(1e-5));

  // All that leaves the floor and walls and all that arrives agree with the exchange factors of a cube. Floor
  // irradiance by the open ceiling: pi times the form factor of opposite squares, 0.19982; walls: perpendicular
  // squares, 0.20004.
  const auto on_floor = [](auto x, auto y) { return x >= 2 && x < 14 && y >= 2 && y < 14; };
  CHECK(mean_irradiance(direct, on_floor) == doctest::Approx(pi * 0.19982).epsilon(0.05));
}

TEST_CASE("a patch that faces the lit ground sees the ground's radiance: albedo, everywhere") {
  // Under a sky of radiance 1 the ground receives pi and reflects albedo * pi / pi.
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-2000, 0, 2000}, {4000, 0, 0}, {0, 0, -4000}, {0, 0}, 0.5f);
  add_rectangle(scene, {-0.01f, 1, -0.01f}, {0.02f, 0, 0}, {0, 0, 0.02f}, {0.75f, 0.75f}, 0.25f);
  const GatheredLight light = gather_light(scene, uniform_environment(1), options(32, 1024, true));
  for (std::uint32_t y = 24; y < 32; ++y)
    for (std::uint32_t x = 24; x < 32; ++x) {
      CHECK(sh(light, y * 32 + x, 0) == doctest::Approx(0.5 * std::sqrt(pi)).epsilon(3e-3));
      CHECK(sh(light, y * 32 + x, 2) == doctest::Approx(0.5 * std::sqrt(3 * pi) / 2).epsilon(1e-2));
      CHECK(light.irradiance[(y * 32 + x) * 3] == doctest::Approx(0.5 * pi).epsilon(3e-3));
    }
}

TEST_CASE("a closed box lets no light in, and the backs of its walls bring none") {
  const GatheredLight dark = gather_light(furnace_scene(0.5f), uniform_environment(1), options(32, 64, true));
  CHECK(*std::max_element(dark.sh.begin(), dark.sh.end()) == 0);
}

TEST_CASE("texels inside geometry take their light from outside it") {
  Scene scene = floor_scene();
  const Scene box = furnace_scene(0.5f);  // its fronts are inside: turned, it is solid
  const std::uint32_t base = std::uint32_t(scene.positions.size());
  for (std::size_t v = 0; v < box.positions.size(); ++v) {
    scene.positions.push_back(box.positions[v] * 0.25f);
    scene.normals.push_back(-box.normals[v]);
    scene.tangents.push_back(box.tangents[v]);
    scene.uvs.push_back(box.uvs[v]);
    scene.lightmap_uvs.push_back({2, 2});  // outside of the lightmap
  }
  for (std::size_t i = 0; i < box.indices.size(); i += 3)
    for (const int k : {0, 2, 1}) scene.indices.push_back(base + box.indices[i + k]);
  scene.triangle_materials.insert(scene.triangle_materials.end(), box.triangle_materials.begin(),
                                  box.triangle_materials.end());
  const GatheredLight light = gather_light(scene, uniform_environment(1), options(32, 128, false));
  const auto irradiance = [&](int x, int y) { return light.irradiance[(y * 32 + x) * 3]; };
  CHECK(irradiance(16, 16) > 1);          // under the middle of the box
  CHECK(irradiance(16, 16) < pi * 0.95);  // and not the open sky's
  CHECK(irradiance(1, 1) > pi * 0.95);
}

TEST_CASE("black environment, one triangle, degenerate triangles: no light, no NaN") {
  Scene scene = floor_scene();
  scene.indices.resize(3);
  scene.triangle_materials.resize(1);
  const GatheredLight black = gather_light(scene, uniform_environment(0), options(8, 32, true));
  CHECK(std::all_of(black.sh.begin(), black.sh.end(), [](float v) { return v == 0; }));

  scene.positions[3] = scene.positions[0];
  for (const std::uint32_t corner : {0, 3, 0, 1, 1, 1}) scene.indices.push_back(corner);
  scene.triangle_materials.assign(3, 0);
  for (const bool per_vertex : {false, true}) {
    if (per_vertex) scene.lightmap_uvs.clear();
    const GatheredLight light = gather_light(scene, uniform_environment(1), options(8, 32, true));
    CHECK(light.storage == (per_vertex ? CoefficientStorage::vertex : CoefficientStorage::lightmap));
    CHECK(std::all_of(light.sh.begin(), light.sh.end(), [](float v) { return std::isfinite(v); }));
    CHECK(light.irradiance[3] == doctest::Approx(pi).epsilon(0.01));
  }
  Scene nothing = scene_with_albedo(1);
  CHECK(gather_light(nothing, uniform_environment(1), options(8, 32, true)).sh.empty());
}

TEST_CASE("a scene without lightmap coordinates is lit at its vertices") {
  Scene scene = furnace_scene(0.5f);
  scene.lightmap_uvs.clear();
  scene.indices.erase(scene.indices.begin() + 6, scene.indices.begin() + 12);
  scene.triangle_materials.resize(10);
  const GatheredLight light = gather_light(scene, uniform_environment(1), options(512, 256, true));
  CHECK(light.width == scene.positions.size());
  CHECK(light.height == 1);
  for (int corner = 0; corner < 4; ++corner) {
    CHECK(light.irradiance[corner * 3] > 0.05);  // the floor sees the opening
    CHECK(light.irradiance[corner * 3] < 0.2 * pi);
  }
}

}  // namespace
}  // namespace twinshade
