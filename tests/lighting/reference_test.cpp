// Precomputed visibility against rays: what each technique's numbers say of points whose light is traced.
#include "lighting/reference.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.h"
#include "base/portable_math.h"
#include "lighting/environment_light.h"
#include "lighting/light_tables.h"
#include "lighting/pca.h"
#include "lighting/radiance_basis.h"
#include "lighting/receivers.h"
#include "lighting/visibility_bake.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

// A floor with a narrow wall and a slanted roof over a part of it.
Scene shadowed_floor() {
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, {0.02f, 0.02f}, 0.6f);
  add_rectangle(scene, {-1, 0, -1}, {2, 0, 0}, {0, 1.5f, 0}, {0.7f, 0.02f}, 0.25f);
  add_rectangle(scene, {1, 0, -1}, {-2, 0, 0}, {0, 1.5f, 0}, {0.7f, 0.35f}, 0.25f);
  add_rectangle(scene, {-1, 1.5f, 0.6f}, {2, 0.3f, 0}, {0, 0.2f, -1}, {0.02f, 0.7f}, 0.25f);
  add_rectangle(scene, {-1, 1.49f, 0.6f}, {0, 0.2f, -1}, {2, 0.3f, 0}, {0.35f, 0.7f}, 0.25f);
  return scene;
}

VisibilityOptions options_with(std::uint32_t rays) {
  VisibilityOptions options;
  options.lightmap_size = 32;
  options.rays = rays;
  options.use_cache = false;
  options.show_progress = false;
  return options;
}

struct Points {
  std::vector<ShadedPoint> list;
  std::vector<std::uint32_t> cell;
};

Points texels_of(const Scene& scene) {
  const RayScene rays(scene);
  const Receivers receivers = lightmap_receivers(scene, rays, 32);
  Points points;
  for (const Receiver& receiver : receivers.list) {
    const Site& site = receivers.sites[receiver.first_site];
    points.list.push_back({site.origin, receiver.normal, glm::vec3(float(portable::kPi)), site.triangle});
    points.cell.push_back(receiver.cell);
  }
  return points;
}

// Red irradiance of points that rows of light times functions give with these weights.
std::vector<double> irradiance_of(const Points& points, std::span<const double> products, int order,
                                  std::span<const float> weights, std::size_t stride, std::size_t count, bool mean) {
  const auto cosine = clamped_cosine_factors();
  const std::size_t n = std::size_t(order * order);
  std::vector<double> values;
  for (std::size_t p = 0; p < points.list.size(); ++p) {
    const glm::dvec3 normal(points.list[p].normal);
    const std::vector<double> y = radiance_basis({&normal, 1}, kMostRadianceCount);
    double irradiance = 0;
    for (std::size_t row = 0; row < count + mean; ++row) {
      const double weight = mean && row == 0 ? 1 : weights[points.cell[p] * stride + row - mean];
      for (std::size_t k = 0; k < n; ++k) irradiance += weight * products[row * 3 * n + k] * cosine[k] * y[k];
    }
    values.push_back(irradiance);
  }
  return values;
}

double rms_difference(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

}  // namespace

TEST_CASE("traced light of an open floor is the environment's irradiance") {
  const Environment environment = uniform_environment(0.75f);
  const Scene scene = floor_scene();
  const std::vector<ShadedPoint> points = {{{0, 0, 0}, {0, 1, 0}, {1, 0.5f, 0}, 0},
                                           {{0, 0, 0}, {0.6f, 0.8f, 0}, {1, 1, 1}, 0}};
  ReferenceOptions options;
  options.rays = 4096;
  options.show_progress = false;
  const std::vector<glm::vec3> traced = reference_radiance(scene, environment, points, options);
  CHECK(traced[0].r == doctest::Approx(0.75).epsilon(1e-4));
  CHECK(traced[0].g == doctest::Approx(0.375).epsilon(1e-4));
  CHECK(traced[0].b == 0);
  // A normal tilted by angle a sees (1 + cos a) / 2 of its light above the plane
  CHECK(traced[1].r == doctest::Approx(0.75 * 0.9).epsilon(3e-3));
  options.rays = 0;
  CHECK_THROWS_AS(reference_radiance(scene, environment, points, options), UserError);
}

TEST_CASE("light that bounces is what form factors say: beside a long wall under even light half is direct") {
  // From the floor the wall fills half of what the cosine weighs, and so does the floor from the wall
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -50}, {0.02f, 0.02f}, 0.45f);
  add_rectangle(scene, {-50, 0, 0}, {100, 0, 0}, {0, 50, 0}, {0.52f, 0.02f}, 0.45f);
  const std::vector<ShadedPoint> points = {{{0, 0, 0.5f}, {0, 1, 0}, {1, 1, 1}, 0}};
  BakeOptions surfaces;
  surfaces.rays = 1024;
  ReferenceOptions options;
  options.rays = 16384;
  options.show_progress = false;
  const auto halves = reference_light(scene, uniform_environment(1), points, surfaces, options);
  for (const auto& half : halves) {
    CHECK(half[0].direct.r == doctest::Approx(0.5).epsilon(0.02));
    CHECK(half[0].bounced.r == doctest::Approx(0.5 * 0.5 * 0.5).epsilon(0.04));
  }
  CHECK(halves[0][0].direct.r != halves[1][0].direct.r);
  options.rays = 0;
  CHECK_THROWS_AS(reference_light(scene, uniform_environment(1), points, surfaces, options), UserError);
}

TEST_CASE("traced light with its bounce is what a lightmap's texels are baked to") {
  const Scene scene = shadowed_floor();
  const Environment environment = load_environment("sky");
  const Points points = texels_of(scene);
  BakeOptions bake;
  bake.lightmap_size = 32;
  bake.rays = 4096;
  bake.use_cache = false;
  bake.show_progress = false;
  ReferenceOptions options;
  options.rays = 4096;
  options.show_progress = false;
  const LightBake light = bake_light(scene, environment, bake);
  const auto halves = reference_light(scene, environment, points.list, bake, options);
  std::vector<double> baked, traced;
  double mean = 0, bounced = 0;
  for (std::size_t i = 0; i < points.list.size(); ++i) {
    baked.push_back(light.irradiance[std::size_t(points.cell[i]) * 3]);
    traced.push_back((halves[0][i].direct.r + halves[0][i].bounced.r + halves[1][i].direct.r + halves[1][i].bounced.r) /
                     2);
    mean += traced.back() / double(points.list.size());
    bounced += halves[0][i].bounced.r / double(points.list.size());
  }
  CHECK(bounced > 0.02 * mean);
  // The bake gathers from all sites of a texel, rays from the first: they differ at shadows' edges
  double difference = 0;
  for (std::size_t i = 0; i < baked.size(); ++i) difference += (baked[i] - traced[i]) / double(baked.size());
  CHECK(std::abs(difference) < 0.02 * mean);
  CHECK(rms_difference(baked, traced) < 0.25 * mean);
}

TEST_CASE("unc6 comes closer to traced light the more rays its visibility has, and the more of its order is kept") {
  const Scene scene = shadowed_floor();
  const std::vector<double> light = environment_radiance(load_environment("sky"), 6);
  const Environment environment = environment_of_radiance(light, 6, 256);
  const Points points = texels_of(scene);
  ReferenceOptions options;
  options.rays = 2048;
  options.show_progress = false;
  std::vector<double> traced;
  double mean = 0;
  for (const glm::vec3& value : reference_radiance(scene, environment, points.list, options)) {
    traced.push_back(value.r);
    mean += value.r / double(points.list.size());
  }

  const std::vector<double> products = light_times_harmonics(light, 6);
  const auto error_with = [&](std::uint32_t rays) {
    const VisibilityBake bake = bake_visibility(scene, options_with(rays));
    return rms_difference(traced, irradiance_of(points, products, 6, bake.sh, kVisibilityCount, 36, false)) / mean;
  };
  const double few = error_with(32), more = error_with(256), many = error_with(4096);
  INFO("relative error with 32, 256 and 4096 rays: " << few << " " << more << " " << many);
  CHECK(few > more);
  CHECK(more > many);
  CHECK(many < 0.04);  // what is left is visibility beyond order 6

  // Principal components: from 4 to all of them, which are unc6
  const VisibilityBake bake = bake_visibility(scene, options_with(4096));
  const PrincipalComponents components = principal_components(bake.sh, kVisibilityCount, 36, bake.area, 36);
  std::vector<double> rows = components.mean;
  rows.insert(rows.end(), components.vectors.begin(), components.vectors.end());
  const std::vector<double> component_products = light_times_vectors(light, rows, 6);
  const std::vector<float> weights = components.project(bake.sh, kVisibilityCount, 36);
  const std::vector<double> all = irradiance_of(points, products, 6, bake.sh, kVisibilityCount, 36, false);
  double before = 1e30, before_traced = 1e30;
  for (const std::size_t count : {0, 1, 2, 4, 8, 12, 16, 24}) {
    const std::vector<double> some = irradiance_of(points, component_products, 6, weights, 36, count, true);
    const double error = rms_difference(all, some), from_traced = rms_difference(traced, some);
    INFO(count << " components: " << error / mean << " off all, " << from_traced / mean << " off the traced light");
    CHECK(error < before);
    CHECK(from_traced < before_traced * 1.02);
    before = error, before_traced = from_traced;
  }
  CHECK(rms_difference(all, irradiance_of(points, component_products, 6, weights, 36, 36, true)) < 1e-6 * mean);
}

}  // namespace twinshade
