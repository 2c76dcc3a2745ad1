#include "lighting/ray_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/error.h"
#include "lighting/random.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

double uniform(std::uint64_t a, std::uint64_t b) { return unit_real(random_bits(7, 99, a, b)); }

glm::vec3 random_point(std::uint64_t i, std::uint64_t stream) {
  return {float(uniform(i, stream) * 2 - 1), float(uniform(i, stream + 1) * 2 - 1),
          float(uniform(i, stream + 2) * 2 - 1)};
}

Scene triangle_soup(int count, float size) {
  Scene scene = scene_with_albedo(0.5f);
  for (int t = 0; t < count; ++t) {
    const glm::vec3 centre = random_point(t, 0);
    for (int k = 0; k < 3; ++k) {
      scene.positions.push_back(centre + random_point(t, 3 + 3 * k) * size);
      scene.normals.push_back({0, 1, 0});
      scene.indices.push_back(std::uint32_t(scene.indices.size()));
    }
    scene.triangle_materials.push_back(0);
  }
  return scene;
}

// Signed volumes in long double: another formula than the one under test.
bool hits(const Scene& scene, std::uint32_t t, const glm::vec3& origin, const glm::vec3& direction, double& distance,
          double& margin) {
  using V = glm::vec<3, long double>;
  const V o(origin), d(direction);
  V p[3];
  for (int k = 0; k < 3; ++k) p[k] = V(scene.positions[scene.indices[3 * t + k]]) - o;
  const long double a = glm::dot(d, glm::cross(p[2], p[1])), b = glm::dot(d, glm::cross(p[0], p[2])),
                    c = glm::dot(d, glm::cross(p[1], p[0]));
  const long double sum = a + b + c;
  const long double least = std::min(std::min(a / sum, b / sum), c / sum);
  margin = std::abs(double(least));
  const V at = (p[0] * a + p[1] * b + p[2] * c) / sum;
  distance = double(glm::dot(at, d) / glm::dot(d, d));
  return least >= 0 && distance > 0;
}

TEST_CASE("the closest hit is that of testing every triangle") {
  const Scene scene = triangle_soup(300, 0.2f);
  const RayScene rays(scene);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 origin = random_point(i, 20) * 1.5f, direction = random_point(i, 23);
    double best = std::numeric_limits<double>::infinity(), worst_margin = 1;
    std::uint32_t expected = kNoTriangle;
    for (std::uint32_t t = 0; t < scene.triangle_count(); ++t) {
      double distance, margin;
      const bool hit = hits(scene, t, origin, direction, distance, margin);
      worst_margin = std::min(worst_margin, margin);
      if (hit && distance < best) best = distance, expected = t;
    }
    if (worst_margin < 1e-9) continue;
    const RayHit hit = rays.closest(origin, direction);
    CAPTURE(i);
    CHECK(hit.triangle == expected);
    CHECK(rays.occluded(origin, direction) == (expected != kNoTriangle));
    if (expected == kNoTriangle) continue;
    ++found;
    CHECK(hit.t == doctest::Approx(best).epsilon(1e-9));
    const auto corner = [&](int k) { return glm::dvec3(scene.positions[scene.indices[3 * expected + k]]); };
    const glm::dvec3 at = corner(0) * (1 - hit.b1 - hit.b2) + corner(1) * hit.b1 + corner(2) * hit.b2;
    CHECK(glm::length(at - (glm::dvec3(origin) + glm::dvec3(direction) * hit.t)) < 1e-9);
  }
  CHECK(found > 500);
}

TEST_CASE("no ray passes between the triangles of a closed mesh") {
  // A fan of rotated, non-representable coordinates around an inner point; rays aimed at edges and corners from inside.
  const Scene box = furnace_scene(0.5f);
  Scene scene = box;
  const float c = std::cos(0.3f), s = std::sin(0.3f);
  for (glm::vec3& p : scene.positions) p = glm::vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z * 1.1f) * 3.7f;
  const RayScene rays(scene);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 origin = random_point(i, 40) * 2.0f;
    const std::uint32_t t = std::uint32_t(random_bits(1, 2, i) % scene.triangle_count());
    const glm::vec3 &a = scene.positions[scene.indices[3 * t]], &b = scene.positions[scene.indices[3 * t + 2]];
    const float along = float(uniform(i, 43));
    const glm::vec3 direction = (i % 5 == 0 ? a : a + (b - a) * along) - origin;
    CAPTURE(i);
    CHECK(rays.occluded(origin, direction));
  }
}

TEST_CASE("what is far from the rest does not lift rays off what is near") {
  for (const int count : {4, 200}) {
    CAPTURE(count);
    Scene scene = triangle_soup(count, 0.5f);
    const glm::vec3 place = scene.positions[0];
    const double alone = RayScene(scene).lift(place);
    CHECK(alone > 1e-5);
    CHECK(alone < 1e-4);
    const std::uint32_t first = std::uint32_t(scene.positions.size());
    for (const glm::vec3& corner :
         {glm::vec3(1e4f), glm::vec3(1e4f, 1e4f + 1, 1e4f), glm::vec3(1e4f + 1, 1e4f, 1e4f)}) {
      scene.positions.push_back(corner);
      scene.normals.push_back({0, 1, 0});
      scene.indices.push_back(first + std::uint32_t(scene.indices.size() - 3 * std::size_t(count)));
    }
    scene.triangle_materials.push_back(0);
    const RayScene rays(scene);
    CHECK(rays.lift(place) < 64 * alone);
    CHECK(rays.lift(place) < 1e-2);            // the diagonal is 17 km: 0.26 without
    CHECK(rays.lift(glm::vec3(1e4f)) > 2e-3);  // 2^-23 of it and more is rounded there
  }
}

TEST_CASE("equal distances: the lowest triangle wins, and a skipped one is not there") {
  Scene scene = floor_scene();
  const Scene copy = scene;
  for (int i = 0; i < 3; ++i) add_rectangle(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, {0, 0}, 1);
  const RayScene rays(scene);
  const glm::vec3 origin(0.3f, 2, 0.1f), down(0, -1, 0);
  const std::uint32_t first = rays.closest(origin, down).triangle;
  CHECK(first < 2);
  CHECK(rays.closest(origin, down, first).triangle == first + 2);
  CHECK(rays.closest(origin, down).t == 2.0);
  CHECK_FALSE(RayScene(copy).occluded(origin, {0, 1, 0}));
}

TEST_CASE("front is where the vertex normals point, whatever the winding") {
  Scene scene = floor_scene();
  const RayScene usual(scene);
  for (std::size_t i = 0; i < scene.indices.size(); i += 3) std::swap(scene.indices[i], scene.indices[i + 1]);
  const RayScene reversed(scene);
  for (const RayScene* rays : {&usual, &reversed}) {
    CHECK(rays->closest({0.1f, 1, 0.2f}, {0, -1, 0}).front);
    CHECK_FALSE(rays->closest({0.1f, -1, 0.2f}, {0, 1, 0}).front);
    CHECK(rays->geometric_normal(0).y == 1);
  }
}

TEST_CASE("triangles without area or with infinite corners are never hit") {
  Scene scene = floor_scene();
  for (const glm::vec3& corner : {glm::vec3(0, 1, 0), glm::vec3(0, 1, 0), glm::vec3(1, 1, 0), glm::vec3(NAN, 1, 0),
                                  glm::vec3(1, 1, 1), glm::vec3(0, 1, INFINITY)}) {
    scene.indices.push_back(std::uint32_t(scene.positions.size()));
    scene.positions.push_back(corner);
    scene.normals.push_back({0, 1, 0});
  }
  scene.triangle_materials.insert(scene.triangle_materials.end(), 2, 0u);
  const RayScene rays(scene);
  CHECK(rays.closest({0, 2, 0}, {0, -1, 0}).t == 2.0);
  CHECK(rays.geometric_normal(2) == glm::dvec3(0));
  CHECK(rays.geometric_normal(3) == glm::dvec3(0));

  scene.indices.erase(scene.indices.begin(), scene.indices.begin() + 6);
  const RayScene nothing(scene);
  CHECK(nothing.closest({0, 2, 0}, {0, -1, 0}).triangle == kNoTriangle);
  CHECK_FALSE(nothing.occluded({0, 2, 0}, {0, -1, 0}));
}

TEST_CASE("a scene too far out for Embree's floats is refused by name, what no triangle uses is not") {
  Scene scene = floor_scene();
  scene.positions.push_back(glm::vec3(1e20f));
  scene.normals.push_back({0, 1, 0});
  scene.tangents.push_back({1, 0, 0, 1});
  scene.uvs.emplace_back(0);
  scene.lightmap_uvs.emplace_back(0);
  CHECK(RayScene(scene).occluded({0, 2, 0}, {0, -1, 0}));
  add_rectangle(scene, {2e15f, 0, 0}, {1e15f, 0, 0}, {0, 0, -1e15f}, {0, 0}, 1);
  std::string refusal;
  try {
    const RayScene rays(scene);
  } catch (const UserError& error) {
    refusal = error.what();
  }
  CHECK(refusal.find("test: ") == 0);
  CHECK(refusal.find("1e15") != std::string::npos);
}

}  // namespace
}  // namespace twinshade
