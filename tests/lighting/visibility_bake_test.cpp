#include "lighting/visibility_bake.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"
#include "tests/lighting/small_scenes.h"
#include "tests/lighting/temporary_cache.h"

namespace twinshade {
namespace {

VisibilityOptions fast_options(std::uint32_t rays = 256) {
  VisibilityOptions options;
  options.lightmap_size = 16;
  options.rays = rays;
  options.use_cache = false;
  options.show_progress = false;
  return options;
}

// Integral of every function over the directions that `seen` says yes to.
template <class Seen>
std::vector<double> coefficients_of(const Seen& seen) {
  const Quadrature points = sphere_quadrature(-1, 128);
  const std::vector<double> y = radiance_basis(points.directions, kVisibilityCount);
  std::vector<double> sum(kVisibilityCount, 0.0);
  for (std::size_t p = 0; p < points.weights.size(); ++p)
    if (seen(points.directions[p]))
      for (std::size_t k = 0; k < kVisibilityCount; ++k) sum[k] += points.weights[p] * y[p * kVisibilityCount + k];
  return sum;
}

double worst_difference(const VisibilityBake& bake, std::size_t cell, const std::vector<double>& expected) {
  double worst = 0;
  for (std::size_t k = 0; k < kVisibilityCount; ++k)
    worst = std::max(worst, std::fabs(bake.sh[cell * kVisibilityCount + k] - expected[k]));
  return worst;
}

// A floor with a box on it that has no bottom.
Scene box_on_floor() {
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, {0, 0}, 0.5f);
  const auto chart = [](int i) { return glm::vec2(0.52f + 0.16f * float(i % 3), 0.02f + 0.2f * float(i / 3)); };
  add_rectangle(scene, {-1, -0.1f, 1}, {2, 0, 0}, {0, 1.1f, 0}, chart(0), 0.12f);
  add_rectangle(scene, {1, -0.1f, -1}, {-2, 0, 0}, {0, 1.1f, 0}, chart(1), 0.12f);
  add_rectangle(scene, {1, -0.1f, 1}, {0, 0, -2}, {0, 1.1f, 0}, chart(2), 0.12f);
  add_rectangle(scene, {-1, -0.1f, -1}, {0, 0, 2}, {0, 1.1f, 0}, chart(3), 0.12f);
  add_rectangle(scene, {-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, chart(4), 0.12f);
  return scene;
}

}  // namespace

TEST_CASE("a floor sees the upper hemisphere, and more rays see it better") {
  const std::vector<double> expected = coefficients_of([](const glm::dvec3& d) { return d.y > 0; });
  // 2 pi sqrt(1/4pi), -pi sqrt(3/4pi): world space, Y1,-1 is along -y
  CHECK(expected[0] == doctest::Approx(1.7724538509).epsilon(1e-3));
  CHECK(expected[1] == doctest::Approx(-1.5349900620).epsilon(1e-3));
  const VisibilityBake coarse = bake_visibility(floor_scene(), fast_options(64)),
                       fine = bake_visibility(floor_scene(), fast_options(16384));
  double worst_coarse = 0, worst_fine = 0;
  for (std::size_t cell = 0; cell < fine.cells(); ++cell) {
    worst_coarse = std::max(worst_coarse, worst_difference(coarse, cell, expected));
    worst_fine = std::max(worst_fine, worst_difference(fine, cell, expected));
    CHECK(fine.ambient[cell] == 1);
    CHECK(fine.area[cell] == doctest::Approx(4.0 / 256).epsilon(1e-5));
    CHECK(fine.normal[cell * 3] == 0);
    CHECK(fine.normal[cell * 3 + 1] == 1);
    CHECK(fine.normal[cell * 3 + 2] == 0);
  }
  CHECK(worst_fine < 0.01);
  CHECK(worst_fine < 0.2 * worst_coarse);
}

TEST_CASE("beside an endless wall a floor sees a quarter of the sphere") {
  // The wall stands over the floor's left edge; at its foot half of the hemisphere is gone.
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {0, 0, 0.005f}, {0.01f, 0, 0}, {0, 0, -0.01f}, {0, 0}, 1);
  Scene wall = scene;
  add_rectangle(wall, {0, -1, 5000}, {0, 0, -10000}, {0, 5000, 0}, {2, 2}, 1);
  scene = wall;
  const std::vector<double> expected = coefficients_of([](const glm::dvec3& d) { return d.y > 0 && d.x > 0; });
  const VisibilityBake bake = bake_visibility(scene, fast_options(8192));
  double worst = 0;
  for (std::size_t cell = 0; cell < bake.cells(); ++cell)
    worst = std::max(worst, worst_difference(bake, cell, expected));
  CHECK(worst < 0.02);
  CHECK(bake.ambient[100] == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("inside a closed room nothing is seen") {
  const VisibilityBake bake = bake_visibility(furnace_scene(0.5f), fast_options());
  for (const float value : bake.sh) CHECK(value == 0);
}

TEST_CASE("texels inside geometry take their values from their neighbours, and gutters are filled") {
  VisibilityOptions options = fast_options(128);
  options.lightmap_size = 64;
  const VisibilityBake bake = bake_visibility(box_on_floor(), options);
  // Texel 16, 16 of the floor's 32 x 32 is under the box
  const std::size_t under = 16 * 64 + 16;
  CHECK(bake.area[under] > 0);
  CHECK(bake.sh[under * kVisibilityCount] > 0.5f);
  CHECK(bake.ambient[under] > 0.2f);
  // Beyond the floor's chart: no surface, but what bilinear filtering reads there is its neighbour's
  const std::size_t beyond = 38 * 64 + 10, edge = 33 * 64 + 10;
  CHECK(bake.area[edge] == 0);
  CHECK(bake.sh[edge * kVisibilityCount] > 1);
  CHECK(bake.sh[beyond * kVisibilityCount] > 1);
  for (const std::size_t cell : {under, edge, beyond}) {
    CHECK(bake.normal[cell * 3] == 0);
    CHECK(bake.normal[cell * 3 + 1] == 1);
    CHECK(bake.normal[cell * 3 + 2] == 0);
  }
}

TEST_CASE("a cached bake of visibility is the bake; a damaged entry is rebuilt") {
  const TemporaryCache cache;
  VisibilityOptions options = fast_options(64);
  options.lightmap_size = 40;
  options.use_cache = true;
  const auto is_same = [](const VisibilityBake& a, const VisibilityBake& b) {
    return a.width == b.width && a.height == b.height && a.storage == b.storage && a.sh == b.sh &&
           a.ambient == b.ambient && a.normal == b.normal && a.area == b.area && a.hash == b.hash && a.notes == b.notes;
  };
  const VisibilityBake first = bake_visibility(box_on_floor(), options);
  CHECK(first.rays_per_second > 0);
  const VisibilityBake second = bake_visibility(box_on_floor(), options);
  CHECK(second.rays_per_second == 0);
  CHECK(is_same(first, second));
  cache.damage();
  const VisibilityBake third = bake_visibility(box_on_floor(), options);
  CHECK(third.rays_per_second > 0);
  CHECK(is_same(first, third));
  for (const bool by_pipes : {true, false}) {
    CAPTURE(by_pipes);
    cache.replace(by_pipes);
    CHECK(is_same(first, bake_visibility(box_on_floor(), options)));
    CHECK(bake_visibility(box_on_floor(), options).rays_per_second == 0);
  }
}

TEST_CASE("scenes without lightmap coordinates are baked per vertex, with a third of each triangle's area") {
  Scene scene = floor_scene();
  scene.lightmap_uvs.clear();
  const VisibilityBake bake = bake_visibility(scene, fast_options(4096));
  CHECK(bake.storage == CoefficientStorage::vertex);
  CHECK(bake.cells() == 4);
  const std::vector<double> expected = coefficients_of([](const glm::dvec3& d) { return d.y > 0; });
  double area = 0;
  for (std::size_t v = 0; v < 4; ++v) {
    CHECK(worst_difference(bake, v, expected) < 0.03);
    area += bake.area[v];
  }
  CHECK(area == doctest::Approx(4));
}

TEST_CASE("texels stand for all that they show: meshes finer than the lightmap weigh as much as coarse ones") {
  // Two floors of the same size, the second of 100 x 100 rectangles; charts reach beyond the texels' middles or do not
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-1, 0, 1}, {1, 0, 0}, {0, 0, -1}, {0.05f, 0.05f}, 0.4f);
  for (int x = 0; x < 100; ++x)
    for (int z = 0; z < 100; ++z)
      add_rectangle(scene, {1 + x * 0.01f, 0, 1 - z * 0.01f}, {0.01f, 0, 0}, {0, 0, -0.01f},
                    {0.55f + x * 0.004f, 0.05f + z * 0.004f}, 0.004f);
  VisibilityOptions options;
  options.lightmap_size = 32, options.rays = 16, options.use_cache = false, options.show_progress = false;
  const VisibilityBake bake = bake_visibility(scene, options);
  double coarse = 0, fine = 0;
  for (std::uint32_t cell = 0; cell < 32 * 32; ++cell) (cell % 32 < 16 ? coarse : fine) += bake.area[cell];
  CHECK(coarse == doctest::Approx(1).epsilon(1e-5));
  CHECK(fine == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("visibility does not depend on threads, and follows its seed") {
  VisibilityOptions options = fast_options(64);
  options.lightmap_size = 40;
  set_thread_count(1);
  const std::string one = bake_visibility(box_on_floor(), options).hash;
  set_thread_count(5);
  CHECK(bake_visibility(box_on_floor(), options).hash == one);
  set_thread_count(0);
  options.seed = 2;
  CHECK(bake_visibility(box_on_floor(), options).hash != one);
}

TEST_CASE("one triangle, and triangles of no size, are baked without a word") {
  Scene scene = floor_scene();
  scene.indices.resize(3);
  scene.triangle_materials.resize(1);
  CHECK(bake_visibility(scene, fast_options(16)).sh[0] > 1);
  scene.indices = {0, 0, 1};
  for (const float value : bake_visibility(scene, fast_options(16)).sh) CHECK(value == 0);
  scene.lightmap_uvs.clear();
  for (const float value : bake_visibility(scene, fast_options(16)).sh) CHECK(value == 0);
}

TEST_CASE("options of visibility are checked") {
  VisibilityOptions options = fast_options();
  options.rays = 0;
  CHECK_THROWS_AS(bake_visibility(floor_scene(), options), UserError);
  options = fast_options();
  options.lightmap_size = 5000;
  CHECK_THROWS_AS(bake_visibility(floor_scene(), options), UserError);
  Scene procedural = floor_scene();
  procedural.procedural_coefficients = true;
  CHECK_THROWS_AS(bake_visibility(procedural, fast_options()), UserError);
}

}  // namespace twinshade
