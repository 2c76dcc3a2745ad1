#include "cpu_shaders/load/host_eval.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.h"
#include "lighting/registry.h"

using namespace twinshade;

TEST_CASE("a basis evaluated in double keeps more digits than the same basis in float") {
  // Y10 = sqrt(3 / (4 pi)) z, with (-1)^m for the others (sh2 is l <= 1).
  const double k = std::sqrt(3.0 / (4.0 * std::acos(-1.0)));
  const std::vector<double> directions = {2.0 / 7, 3.0 / 7, 6.0 / 7};
  const std::vector<double> in_double = evaluate_basis("sh2", directions);
  const std::vector<double> in_float = evaluate_basis("sh2", directions, Number::scalar);
  REQUIRE(in_double.size() == 4);
  const double expected[] = {0.5 / std::sqrt(std::acos(-1.0)), -k * 3 / 7, k * 6 / 7, -k * 2 / 7};
  for (int i = 0; i < 4; ++i) {
    CHECK(std::abs(in_double[i] - expected[i]) < 3e-8);  // the constants are float literals
    CHECK(std::abs(in_float[i] - expected[i]) < 1.2e-7);
    CHECK(double(float(in_float[i])) == in_float[i]);
  }
  CHECK(in_double[2] / in_double[1] == doctest::Approx(-2.0).epsilon(1e-15));  // one constant: the ratio has no rounding
}

TEST_CASE("rows beyond one block are evaluated like the first") {
  std::vector<double> directions;
  for (int i = 0; i < 2500; ++i) directions.insert(directions.end(), {0.6, 0.0, 0.8});
  const std::vector<double> values = evaluate_basis("h6", directions);
  REQUIRE(values.size() == 2500 * 6);
  for (std::size_t i = 6; i < values.size(); ++i) CHECK(values[i] == values[i % 6]);
}

TEST_CASE("a technique that is no basis is refused by name") {
  CHECK_THROWS_WITH_AS(evaluate_basis("facets", {0, 0, 1}), doctest::Contains("facets"), UserError);
}
