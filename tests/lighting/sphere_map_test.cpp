// Sphere maps: what their texels look at and what a direction reads, by the translated GLSL in double and in float.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "lighting/random.h"
#include "lighting/sphere_map_grid.h"

namespace twinshade {
namespace {

glm::dvec3 random_direction(std::uint64_t i) {
  const double z = 2 * unit_real(random_bits(7, 1, i)) - 1;
  const double phi = 2 * std::numbers::pi * unit_real(random_bits(7, 2, i));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

std::vector<glm::dvec3> directions_to_try() {
  std::vector<glm::dvec3> all;
  for (const double x : {-1.0, -0.0, 0.0, 1.0})
    for (const double y : {-1.0, -0.0, 0.0, 1.0})
      for (const double z : {-1.0, -0.0, 0.0, 1.0}) {
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > 0) all.emplace_back(x / length, y / length, z / length);
      }
  for (std::uint64_t i = 0; i < 20000; ++i) all.push_back(random_direction(i));
  return all;
}

double read(const std::vector<double>& texels, const SphereMapTaps& taps) {
  double sum = 0;
  for (int t = 0; t < 4; ++t) sum += taps.weight[t] * texels[taps.texel[t]];
  return sum;
}

// Values that tell texels apart; the same where two texels look the same way.
std::vector<double> bumpy(const std::vector<glm::dvec3>& directions) {
  std::vector<double> values;
  for (const glm::dvec3& d : directions)
    values.push_back(std::sin(23 * d.x + 5) + std::sin(19 * d.y) + std::sin(29 * d.z));
  return values;
}

constexpr int kWidths[] = {1, 2, 3, 4, 5, 8, 9, 16, 17, 32};

}  // namespace

TEST_CASE("texels of every sphere map look in unit directions, spread over the whole sphere") {
  for (const SphereMapInfo& map : sphere_maps())
    for (const int width : kWidths) {
      CAPTURE(map.name);
      CAPTURE(width);
      glm::dvec3 sum(0);
      for (const glm::dvec3& d : SphereMapGrid(map, width).directions()) {
        CHECK(glm::length(d) == doctest::Approx(1).epsilon(1e-7));
        sum += d;
      }
      if (map.layers > 1) CHECK(glm::length(sum) < 1e-6 * map.texels(width));
    }
}

TEST_CASE("the direction of a texel reads that texel") {
  for (const SphereMapInfo& map : sphere_maps())
    for (const int width : kWidths) {
      CAPTURE(map.name);
      CAPTURE(width);
      const SphereMapGrid grid(map, width);
      const std::vector<glm::dvec3> directions = grid.directions();
      const std::vector<double> texels = bumpy(directions);
      const std::vector<SphereMapTaps> taps = grid.taps(directions);
      for (std::size_t i = 0; i < taps.size(); ++i)
        CHECK(read(texels, taps[i]) == doctest::Approx(texels[i]).epsilon(2e-5));
    }
}

TEST_CASE("of the usual width normals along the axes read texels that look about them, whatever the map") {
  const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const auto farthest = [&](const SphereMapInfo& map, int width) {
    const SphereMapGrid grid(map, width);
    const std::vector<glm::dvec3> directions = grid.directions();
    const std::vector<SphereMapTaps> taps = grid.taps(axes);
    double degrees = 0;
    for (int i = 0; i < 6; ++i) {
      glm::dvec3 mean(0);
      for (int t = 0; t < 4; ++t) mean += taps[i].weight[t] * directions[taps[i].texel[t]];
      degrees =
          std::max(degrees, std::asin(glm::length(glm::cross(glm::normalize(mean), axes[i]))) * 180 / std::numbers::pi);
    }
    return degrees;
  };
  for (const SphereMapInfo& map : sphere_maps()) {
    CAPTURE(map.name);
    CHECK(map.has_axes(map.usual_width()));
    CHECK(farthest(map, map.usual_width()) < 0.02);
  }
  CHECK(!find_sphere_map("octahedral").has_axes(32));
  CHECK(farthest(find_sphere_map("octahedral"), 32) == doctest::Approx(1.90).epsilon(0.01));
  CHECK(farthest(find_sphere_map("octahedral_equal_area"), 32) == doctest::Approx(3.65).epsilon(0.01));
}

TEST_CASE("weights are no less than zero and sum to one, texels exist, in double and in float") {
  const std::vector<glm::dvec3> directions = directions_to_try();
  for (const SphereMapInfo& map : sphere_maps())
    for (const int width : kWidths)
      for (const Number number : {Number::float64, Number::scalar}) {
        CAPTURE(map.name);
        CAPTURE(width);
        for (const SphereMapTaps& taps : SphereMapGrid(map, width).taps(directions, number)) {
          double sum = 0;
          for (int t = 0; t < 4; ++t) {
            REQUIRE(taps.texel[t] < std::uint32_t(map.texels(width)));
            REQUIRE(taps.weight[t] >= 0);
            sum += taps.weight[t];
          }
          REQUIRE(sum == doctest::Approx(1).epsilon(1e-6));
        }
      }
}

TEST_CASE("a direction that is none reads texels that exist") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<glm::dvec3> directions = {{0, 0, 0},   {-0.0, -0.0, -0.0}, {nan, nan, nan}, {nan, 0, 1},
                                              {inf, 0, 1}, {inf, -inf, inf},   {1, nan, 0},     {0, 1, nan}};
  for (const SphereMapInfo& map : sphere_maps())
    for (const int width : kWidths)
      for (const Number number : {Number::float64, Number::scalar})
        for (const SphereMapTaps& taps : SphereMapGrid(map, width).taps(directions, number))
          for (const std::uint32_t texel : taps.texel) {
            CAPTURE(map.name);
            CHECK(texel < std::uint32_t(map.texels(width)));
          }
}

TEST_CASE("all maps but the cube of DirectX 9 are continuous, across edges, equator and folds too") {
  for (const SphereMapInfo& map : sphere_maps()) {
    CAPTURE(map.name);
    const SphereMapGrid grid(map, 9);
    const std::vector<double> texels = bumpy(grid.directions());
    // Pairs on both sides of what might be a seam: coordinate planes, diagonals of the cube
    std::vector<glm::dvec3> pairs;
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const glm::dvec3 d = random_direction(i);
      for (const glm::dvec3& plane :
           {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, -1, 0),
            glm::dvec3(0, 1, 1), glm::dvec3(0, 1, -1), glm::dvec3(1, 0, 1), glm::dvec3(1, 0, -1)}) {
        const glm::dvec3 n = glm::normalize(plane), on = d - n * glm::dot(d, n);
        pairs.push_back(glm::normalize(on + 1e-9 * n));
        pairs.push_back(glm::normalize(on - 1e-9 * n));
      }
    }
    const std::vector<SphereMapTaps> taps = grid.taps(pairs);
    double worst = 0;
    for (std::size_t i = 0; i < taps.size(); i += 2)
      worst = std::max(worst, std::fabs(read(texels, taps[i]) - read(texels, taps[i + 1])));
    if (map.name == "cube_dx9")
      CHECK(worst > 0.1);
    else if (map.name == "dual_orthographic")
      CHECK(worst < 2e-3);  // its slope is infinite at the equator
    else
      CHECK(worst < 1e-5);
  }
}

TEST_CASE("the missing tap at a cube's corner is the mean of the other three") {
  const SphereMapGrid grid(find_sphere_map("cube"), 8);
  const double third = 1 / std::sqrt(3.0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 d(corner & 1 ? third : -third, corner & 2 ? third : -third, corner & 4 ? third : -third);
    int used = 0;
    const SphereMapTaps taps = grid.taps({&d, 1})[0];
    for (int t = 0; t < 4; ++t)
      if (taps.weight[t] > 0) {
        ++used;
        CHECK(taps.weight[t] == doctest::Approx(1 / 3.0).epsilon(1e-6));
      }
    CHECK(used == 3);
  }
}

TEST_CASE("texels of the equal-area octahedron cover equal solid angles") {
  // Each octant of the sphere holds as many texel centres, and the mean of z^2 is 1/3 up to the grid's own error.
  const SphereMapGrid grid(find_sphere_map("octahedral_equal_area"), 129);
  double sum = 0, weight = 0;
  const std::vector<glm::dvec3> directions = grid.directions();
  for (int y = 0; y < 129; ++y)
    for (int x = 0; x < 129; ++x) {
      const double w = (x % 128 ? 1 : 0.5) * (y % 128 ? 1 : 0.5);  // trapezoid rule: a border texel is half outside
      const glm::dvec3& d = directions[std::size_t(y * 129 + x)];
      sum += w * d.z * d.z;
      weight += w;
    }
  CHECK(sum / weight == doctest::Approx(1 / 3.0).epsilon(1e-3));
}

TEST_CASE("texels that look the same way are counted once") {
  CHECK(SphereMapGrid(find_sphere_map("cube"), 8).distinct_texels() == 6 * 64);
  CHECK(SphereMapGrid(find_sphere_map("dual_paraboloid"), 9).distinct_texels() == 2 * 81 - 32);
  CHECK(SphereMapGrid(find_sphere_map("octahedral"), 9).distinct_texels() == 81 - 15);
}

TEST_CASE("a sphere map's width and name are checked") {
  CHECK_THROWS_WITH_AS(SphereMapGrid(find_sphere_map("cube"), 0), "width of sphere map cube: 0 is not within 1 to 4096",
                       UserError);
  CHECK_THROWS_AS(SphereMapGrid(find_sphere_map("cube"), 4097), UserError);
  CHECK_THROWS_AS(find_sphere_map("cub"), UserError);
}

}  // namespace twinshade
