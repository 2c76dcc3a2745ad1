// Every basis at every kind of direction: never NaN, never an index out of range, irradiance as the sum of its terms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/basis/all_directions.h"
#include "tests/basis/support.h"

namespace twinshade::test {

TEST_CASE("no basis gives NaN: axes, vertices, edges, signed zeros, zero, NaN, random directions") {
  std::vector<glm::dvec3> directions = special_directions();
  Uniform uniform(31);
  for (int i = 0; i < 20000; ++i) directions.push_back(awkward_direction(uniform));
  for (const TechniqueInfo& basis : techniques())
    if (basis.is_basis) CHECK_MESSAGE(count_not_finite(basis, directions) == 0, std::string(basis.name));
}

TEST_CASE("the triangle of the icosahedron is the one that brute force finds") {
  std::vector<glm::dvec3> directions = special_directions();
  Uniform uniform(32);
  for (int i = 0; i < 200000; ++i) directions.push_back(awkward_direction(uniform));
  CHECK(count_wrong_triangles(directions) == 0);
}

TEST_CASE("zero and NaN count as the same direction, with an index in range") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis) continue;
    CAPTURE(std::string(basis.name));
    const std::vector<glm::dvec3> coefficients = random_vectors(basis.count, 33);
    const std::vector<glm::dvec3> e =
        irradiance(basis.name, coefficients, {{0, 0, 0}, {nan, 0, 1}, {0, nan, 0}, {0, 0, -nan}}, Number::scalar).rgb;
    for (const glm::dvec3& value : e) CHECK(value == e[0]);
    CHECK(std::isfinite(e[0].x));
  }
}

TEST_CASE("irradiance of a linear basis is the sum of coefficients times basis values") {
  std::vector<glm::dvec3> directions = special_directions();
  Uniform uniform(34);
  for (int i = 0; i < 500; ++i) directions.push_back(uniform.direction());
  const auto nan = [](const glm::dvec3& d) { return std::isnan(d.x + d.y + d.z); };
  directions.erase(std::remove_if(directions.begin(), directions.end(), nan), directions.end());
  for (const TechniqueInfo* basis : bases(true)) {
    CAPTURE(std::string(basis->name));
    const std::vector<glm::dvec3> coefficients = random_vectors(basis->count, 35);
    for (const Number number : {Number::float64, Number::scalar}) {
      const std::vector<double> terms = values(basis->name, directions, number);
      const std::vector<glm::dvec3> e = irradiance(basis->name, coefficients, directions, number).rgb;
      for (std::size_t r = 0; r < directions.size(); ++r) {
        glm::dvec3 sum(0);
        for (int i = 0; i < basis->count; ++i) sum += coefficients[i] * terms[r * basis->count + i];
        CAPTURE(hex(directions[r]));
        CHECK(glm::length(sum - e[r]) < (number == Number::float64 ? 1e-13 : 1e-5));
      }
    }
  }
}

TEST_CASE("coefficients read: no more than the papers'") {
  struct Row {
    const char* basis;
    int reads;
  };
  for (const Row& row :
       {Row{"lightmap", 1}, Row{"hl2", 3}, Row{"h6", 6}, Row{"sh3", 9}, Row{"sh6", 36}, Row{"ambient_cube", 3},
        Row{"ad_linear_planar", 3}, Row{"ad_linear_spherical", 3}, Row{"ad_flat", 9}, Row{"ad_spherical", 9},
        Row{"ad_ycocg", 6}, Row{"ad_cos2", 6}, Row{"ad_cos2cos4_raw", 6}, Row{"ad_cos2cos4", 6}, Row{"zh3", 5},
        Row{"zh3_hallucinated", 4}, Row{"l1_nonlinear", 4}, Row{"ahd", 3}, Row{"sg9", 9}}) {
    CAPTURE(row.basis);
    const TechniqueInfo& basis = find_technique(row.basis);
    for (const int reads : irradiance(row.basis, random_vectors(basis.count, 36), special_directions()).reads)
      CHECK(reads == row.reads);
  }
}

}  // namespace twinshade::test
