// Relations between bases of the hemisphere, evaluated in double from their GLSL: the matrix T_h of Habel and Wimmer
// (I3D 2010, eq. 14 and appendix A), and what spans what.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/basis/support.h"

namespace twinshade::test {

// Constants are rounded to float: 2^-24 relative in each factor.
constexpr double kTolerance = 3e-7;

TEST_CASE("products of the H-basis and spherical harmonics on the hemisphere are T_h, signs included") {
  // (row H, column Y): the entries that are not zero, l <= 4
  struct Entry {
    std::size_t h, y;
    double value;
  };
  const double r2 = std::sqrt(2.0), r6 = std::sqrt(6.0), r10 = std::sqrt(10.0), r14 = std::sqrt(14.0);
  const std::vector<Entry> entries = {{0, 0, r2 / 2},
                                      {0, 2, r6 / 4},
                                      {0, 12, -r14 / 16},
                                      {1, 1, r2 / 2},
                                      {1, 5, 3 * r10 / 16},
                                      {1, 19, -std::sqrt(15.0) / 16},
                                      {2, 2, r2 / 4},
                                      {2, 6, std::sqrt(30.0) / 8},
                                      {2, 12, std::sqrt(42.0) / 16},
                                      {2, 20, -r6 / 16},
                                      {3, 3, r2 / 2},
                                      {3, 7, 3 * r10 / 16},
                                      {3, 21, -std::sqrt(15.0) / 16},
                                      {4, 4, r2 / 2},
                                      {4, 10, 5 * r14 / 32},
                                      {5, 8, r2 / 2},
                                      {5, 14, 5 * r14 / 32}};
  std::vector<double> expected(6 * 25);
  for (const Entry& entry : entries) expected[entry.h * 25 + entry.y] = entry.value;
  const std::vector<double> computed = products("h6", "sh5", rings(0, 12));
  REQUIRE(computed.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i / 25);
    CAPTURE(i % 25);
    CHECK(std::fabs(computed[i] - expected[i]) < kTolerance);
  }
}

TEST_CASE("the Half-Life 2 basis is the cosine to its three directions") {
  const double a = 1 / std::sqrt(6.0), b = 1 / std::sqrt(2.0), c = 1 / std::sqrt(3.0);
  const std::array<std::array<double, 3>, 3> axes = {{{-a, -b, c}, {-a, b, c}, {2 * a, 0, c}}};
  std::vector<glm::dvec3> directions;
  for (const auto& axis : axes) directions.emplace_back(axis[0], axis[1], axis[2]);
  const std::vector<double> value = values("hl2", directions);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      CHECK(std::fabs(value[i * 3 + j] - (i == j ? std::sqrt(3 / (2 * kPi)) : 0)) < kTolerance);
}

TEST_CASE("directional occlusion spans what the Half-Life 2 basis spans") {
  const Points q = rings(0, 12);
  const std::vector<double> change = products("hl2", "directional_occlusion", q);  // a rotation, if they do
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += change[i * 3 + k] * change[j * 3 + k];
      CHECK(std::fabs(dot - (i == j ? 1 : 0)) < 3 * kTolerance);
    }
}

}  // namespace twinshade::test
