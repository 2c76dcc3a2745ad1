#include "scenes/face_normals.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/portable_math.h"

using namespace twinshade;
using glm::dvec3;

namespace {

const double kCosCrease = std::cos(portable::kPi / 4);

// Triangles with a corner at the origin, facing all ways.
std::vector<glm::vec3> random_fan(std::size_t triangles) {
  std::mt19937 bits(5);
  const auto real = [&] { return float(bits() >> 8) / float(1 << 23) - 1; };
  std::vector<glm::vec3> corners;
  for (std::size_t t = 0; t < triangles; ++t) {
    corners.emplace_back(0);
    for (int k = 0; k < 2; ++k) corners.emplace_back(real(), real(), real());
  }
  return corners;
}

glm::dvec3 area_of(const std::vector<glm::vec3>& corners, std::size_t t) {
  const dvec3 a(corners[3 * t]), b(corners[3 * t + 1]), c(corners[3 * t + 2]);
  return glm::cross(b - a, c - a);
}

}  // namespace

TEST_CASE("normals around one place are those of the triangles within the crease angle, of few triangles and of many") {
  for (const std::size_t count : {20u, 256u, 257u, 1500u}) {
    const std::vector<glm::vec3> corners = random_fan(count), normals = face_normals(corners, kCosCrease);
    double largest = 0;
    for (std::size_t t = 0; t < count; ++t) {
      dvec3 sum(0);
      for (std::size_t other = 0; other < count; ++other)
        if (glm::dot(glm::normalize(area_of(corners, t)), glm::normalize(area_of(corners, other))) >= kCosCrease)
          sum += area_of(corners, other);
      largest = std::max(largest, glm::length(dvec3(normals[3 * t]) - glm::normalize(sum)));
    }
    CAPTURE(count);
    CHECK(largest < 1e-6);
  }
}

TEST_CASE("a fan of 100,000 triangles in a plane, with some without area, has normals at once") {
  std::vector<glm::vec3> corners;
  for (int t = 0; t < 100000; ++t) {
    const float at = float(t % 1000) / 1000;
    corners.insert(corners.end(), {glm::vec3(0), glm::vec3(1, at, 0), glm::vec3(1, t % 7 ? at + 0.001f : at, 0)});
  }
  for (const glm::vec3& n : face_normals(corners, kCosCrease)) REQUIRE(n == glm::vec3(0, 0, 1));
}
