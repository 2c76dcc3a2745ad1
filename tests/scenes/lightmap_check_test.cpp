#include "scenes/lightmap_check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace twinshade;
using glm::dvec2;

namespace {

constexpr double kGrid = 1024;

// Triangles in the map, each as large in space as there.
struct Map {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;
  std::vector<std::uint32_t> indices;

  void add(const std::array<glm::vec2, 3>& triangle) {
    for (const glm::vec2& uv : triangle) {
      indices.push_back(std::uint32_t(uvs.size()));
      uvs.push_back(uv);
      positions.emplace_back(uv, 0);
    }
  }
  std::string fault() const { return lightmap_fault(positions, uvs, indices); }
};

// A triangle around one sample of the grid and no other.
std::array<glm::vec2, 3> around(const dvec2& sample) {
  return {glm::vec2((sample + dvec2(-0.4, -0.3)) / kGrid), glm::vec2((sample + dvec2(0.4, -0.3)) / kGrid),
          glm::vec2((sample + dvec2(0, 0.4)) / kGrid)};
}

// How far inside the triangle a point is, in samples: its distance from the nearest edge; below 0 outside.
double depth(const std::array<glm::vec2, 3>& triangle, const dvec2& point) {
  double least = kGrid;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec2 a = dvec2(triangle[k]) * kGrid, b = dvec2(triangle[(k + 1) % 3]) * kGrid,
                c = dvec2(triangle[(k + 2) % 3]) * kGrid;
    const dvec2 normal = glm::normalize(dvec2(a.y - b.y, b.x - a.x));
    const double opposite = glm::dot(normal, c - a);
    least = std::min(least, glm::dot(normal, point - a) * (opposite > 0 ? 1 : -1));
  }
  return least;
}

}  // namespace

TEST_CASE("a sample inside two triangles is an overlap, one inside one of them is not") {
  std::mt19937 random(7);
  const auto unit = [&] { return float(random() * 0x1p-32); };
  int inside = 0, outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec2 a(unit(), unit());
    glm::vec2 b(unit(), unit()), c(unit(), unit());
    // Small; long and thin; along a row, a column, almost a row; edges through samples
    if (i % 7 == 1) b = glm::mix(a, b, 0.01f), c = glm::mix(a, c, 0.01f);
    if (i % 7 == 2) c = glm::mix(glm::mix(a, b, unit()), c, 0.003f);
    if (i % 7 == 3) b.y = a.y;
    if (i % 7 == 4) b.x = a.x;
    if (i % 7 == 5) b.y = std::min(a.y + 1e-6f * unit(), 1.0f);
    if (i % 7 == 6) b.y = (std::floor(a.y * 1023) + 0.5f) / 1024, c.x = (std::floor(b.x * 1023) + 0.5f) / 1024;
    const std::array<glm::vec2, 3> triangle = {a, b, c};
    // Near one of its edges, or far
    const glm::vec2 edge = glm::mix(triangle[std::size_t(i % 3)], triangle[std::size_t((i + 1) % 3)], unit());
    const dvec2 near = glm::floor(dvec2(edge) * kGrid + 3.0 * dvec2(unit() - 0.5f, unit() - 0.5f)) + 0.5;
    const dvec2 sample = glm::clamp(i % 5 ? near : glm::floor(dvec2(unit(), unit()) * kGrid) + 0.5, 0.5, kGrid - 0.5);
    const double deep = depth(triangle, sample);
    if (std::fabs(deep - 0.01) < 1e-6) continue;
    (deep > 0.01 ? inside : outside) += 1;
    Map map;
    map.add(triangle);
    CHECK(map.fault() == "");
    map.add(around(sample));
    CAPTURE(i);
    CHECK(map.fault() == (deep > 0.01 ? "charts overlap" : ""));
  }
  CHECK(inside > 400);
  CHECK(outside > 400);
}

TEST_CASE("long thin triangles side by side can hold a lightmap, and take the samples that lie inside them") {
  for (const int count : {500, 200000}) {  // up to four samples wide, and a hundredth
    Map map;
    const auto border = [count](int k) {
      const double s = 2.0 * k / count;
      return s < 1 ? glm::vec2(1, s) : glm::vec2(2 - s, 1);
    };
    for (int k = 0; k < count; ++k) map.add({glm::vec2(0), border(k), border(k + 1)});
    CAPTURE(count);
    CHECK(map.fault() == "");
    map.add({glm::vec2(0.2f, 0.3f), glm::vec2(0.6f, 0.3f), glm::vec2(0.2f, 0.6f)});
    CHECK(map.fault() == (count == 500 ? "charts overlap" : ""));
  }
}

TEST_CASE("a triangle hardly wider than what belongs to none takes the samples in its middle") {
  for (const auto& [height, taken] : {std::pair{0.03, true}, {0.019, false}}) {
    Map map;
    map.add({glm::vec2(0, (100.5 - height / 2) / kGrid), glm::vec2(1, (100.5 - height / 2) / kGrid),
             glm::vec2(0, (100.5 + height / 2) / kGrid)});
    map.add(around(dvec2(0.5, 100.5)));
    CHECK(map.fault() == (taken ? "charts overlap" : ""));
  }
}

TEST_CASE("coordinates outside of the map, and surfaces that are lines in it, hold no lightmap") {
  Map map;
  map.add({glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1)});
  CHECK(map.fault() == "");
  Map outside = map;
  outside.uvs[2].y = 1.001f;
  CHECK(outside.fault() == "some lie outside [0, 1]");
  outside.uvs[2].y = NAN;
  CHECK(outside.fault() == "some lie outside [0, 1]");
  Map line = map;
  line.add({glm::vec2(0, 0.5f), glm::vec2(0, 0.5f), glm::vec2(0.1f, 0.6f)});
  line.positions[4].x = 1;
  CHECK(line.fault() == "some triangles have no area in them");
}
