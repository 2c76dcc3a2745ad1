// Where methods fail: figures worked out independently, and properties of the inputs that are found.
#include "experiments/stability/stability.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/parallel.h"
#include "experiments/stability/seams.h"
#include "lighting/projection.h"
#include "lighting/quadrature.h"

namespace twinshade {
namespace {

Rows measured(const std::vector<std::string>& methods, const std::vector<std::string>& tests) {
  StabilityOptions options;
  options.methods = methods;
  options.tests = tests;
  options.pictures = false;
  return run_stability(options).rows;
}

std::size_t row_of(const Rows& rows, const std::string& method, const std::string& test, const std::string& measure) {
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows.at(row, "method") == Cell(method) && rows.at(row, "test") == Cell(test) &&
        rows.at(row, "measure") == Cell(measure))
      return row;
  FAIL("no row for " << method << " " << test << " " << measure);
  return 0;
}

double value(const Rows& rows, const std::string& method, const std::string& test, const std::string& measure) {
  return rows.number(row_of(rows, method, test, measure), "value");
}

std::vector<double> hex_numbers(const Cell& cell) {
  std::vector<double> numbers;
  std::istringstream text(std::get<std::string>(cell));
  for (std::string word; text >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

glm::dvec3 direction(const Cell& cell) {
  const std::vector<double> numbers = hex_numbers(cell);
  REQUIRE(numbers.size() == 3);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

TEST_CASE("ringing of a unit sun is that of exact algebra, over all elevations") {
  const std::map<std::string, double> least{{"sh2", -.25},  {"sh3", -.0396}, {"sh5", -.03125}, {"h4", -.335},
                                            {"hl2", -.579}, {"h6", -.254},   {"lightmap", 0}};
  std::vector<std::string> methods;
  for (const auto& [method, ringing] : least) methods.push_back(method);
  const Rows rows = measured(methods, {"ringing"});
  for (const auto& [method, ringing] : least) {
    CHECK(value(rows, method, "ringing", "least") == doctest::Approx(ringing).epsilon(2e-3));
  }
  CHECK(value(rows, "sh2", "ringing", "greatest") == doctest::Approx(.75).epsilon(1e-5));
  CHECK(value(rows, "lightmap", "ringing", "greatest") == doctest::Approx(1).epsilon(1e-5));
  const std::size_t sh3 = row_of(rows, "sh3", "ringing", "least");
  const double cosine = glm::dot(direction(rows.at(sh3, "light")), direction(rows.at(sh3, "normal")));
  CHECK(std::acos(cosine) * 180 / 3.14159265358979 == doctest::Approx(122).epsilon(5e-3));
}

TEST_CASE("the input that is shown gives the value that is shown") {
  const Rows rows = measured({"sh3", "ad_linear_spherical", "hl2", "zh3"}, {"ringing", "constant"});
  REQUIRE(rows.size() == 16);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    CAPTURE(row);
    const TechniqueInfo& basis = find_technique(std::get<std::string>(rows.at(row, "method")));
    const glm::dvec3 normal = direction(rows.at(row, "normal"));
    const std::vector<double> irradiance =
        reconstruct(basis, hex_numbers(rows.at(row, "coefficients")), {&normal, 1}, Number::float64);
    CHECK(irradiance[0] == rows.number(row, "value"));
  }
}

TEST_CASE("constant light: exact where the method holds it, 1.5 z of Half-Life 2's basis") {
  const Rows rows = measured({"hl2", "h4", "sh2", "ambient_cube", "ad_flat", "l1_nonlinear", "zh3"}, {"constant"});
  CHECK(value(rows, "hl2", "constant", "least") == doctest::Approx(0).epsilon(1e-6));
  CHECK(value(rows, "hl2", "constant", "greatest") == doctest::Approx(1.5).epsilon(1e-6));
  for (const char* exact : {"h4", "sh2", "ambient_cube", "ad_flat", "l1_nonlinear", "zh3"})
    for (const char* measure : {"least", "greatest"}) {
      CAPTURE(exact);
      CHECK(value(rows, exact, "constant", measure) == doctest::Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("condition numbers of the Gram matrices") {
  const std::map<std::string, double> condition{{"ambient_cube", 2.5},
                                                {"ad_linear_planar", 3.973},
                                                {"ad_linear_spherical", 4.217},
                                                {"ad_cos2cos4", 13.04},
                                                {"ad_cos2", 27.19},
                                                {"ad_flat", 363.3},
                                                {"ad_spherical", 203.8},
                                                {"sh2_lsq", 13.9},
                                                {"sh3_lsq", 254},
                                                {"sh3", 1}};
  std::vector<std::string> methods{"zh3"};  // has no Gram matrix
  for (const auto& [method, expected] : condition) methods.push_back(method);
  const Rows rows = measured(methods, {"conditioning"});
  CHECK(rows.size() == condition.size());
  for (const auto& [method, expected] : condition) {
    CHECK(value(rows, method, "conditioning", "condition") == doctest::Approx(expected).epsilon(2e-3));
  }
}

TEST_CASE("bases and sphere maps do not give NaN inside their domain, outside some do") {
  const Rows rows = measured({"h6", "hsh9", "zernike6", "sh3", "ambient_cube", "ad_linear_planar", "zh3",
                              "l1_nonlinear", "ahd", "sg9", "cube", "dual_orthographic", "octahedral"},
                             {"finite"});
  int inside = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows.at(row, "measure") != Cell(std::string("inside"))) continue;
    ++inside;
    CAPTURE(std::get<std::string>(rows.at(row, "method")));
    CHECK(rows.number(row, "value") == 0);
  }
  CHECK(inside == 13);
  CHECK_FALSE(stability_fails(rows));
  // A length of 1000 is too much for an exponential
  CHECK(value(rows, "sg9", "finite", "other normals") > 0);
}

TEST_CASE("seams are found between neighbouring floats, and nothing where there is none") {
  const std::vector<TrickyNormal> tricky = tricky_normals(Domain::sphere);
  const SeamSearch search(tricky, false, [](const glm::dvec3& n) { return glm::dvec3(glm::vec3(unit(n))); });
  const auto shaded = [&](const std::function<double(const glm::dvec3&)>& f) {
    return search.find([&](std::span<const glm::dvec3> normals) {
      std::vector<glm::dvec3> values;
      for (const glm::dvec3& n : normals) values.emplace_back(f(n));
      return values;
    });
  };
  const Seams smooth = shaded([](const glm::dvec3& n) { return 1 + n.x * n.y; });
  CHECK(smooth.jump < 1e-6);
  CHECK(smooth.crease < 0.02);
  const Seams seam = shaded([](const glm::dvec3& n) { return n.x + 0.3 * n.y < 0.123 ? 1.0 : 0.995; });
  CHECK(seam.jump == doctest::Approx(0.005));
  CHECK(glm::length(seam.jump_at[0] - seam.jump_at[1]) < 1e-6);
  const Seams fold = shaded([](const glm::dvec3& n) { return 1 - 0.5 * std::abs(n.x + 0.3 * n.y - 0.123); });
  CHECK(fold.jump < 1e-6);
  CHECK(fold.crease > 0.5);
  const Seams zeros = shaded([](const glm::dvec3& n) { return std::signbit(n.x) && n.x == 0 ? 0.5 : 1.0; });
  CHECK(zeros.jump == doctest::Approx(0.5));
}

TEST_CASE("a cube map that ends at each face's edge has seams, one that is filtered across them has none") {
  const Rows rows = measured({"cube", "cube_dx9"}, {"jump", "constant"});
  CHECK(value(rows, "cube", "jump", "value") < 1e-6);
  CHECK(value(rows, "cube_dx9", "jump", "value") > 0.01);
  CHECK(rows.at(row_of(rows, "cube_dx9", "jump", "value"), "verdict") == Cell(std::string("poor")));
  CHECK(value(rows, "cube", "constant", "least") == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("the equal-area octahedron has no steps next to the poles, where 1 - |z| is nothing but rounding") {
  CHECK(value(measured({"octahedral_equal_area"}, {"jump"}), "octahedral_equal_area", "jump", "value") < 1e-4);
}

TEST_CASE("what is not linear in the light shows in blends, and where opposite suns leave no direction") {
  const Rows rows = measured({"sh3", "zh3", "zh3_hallucinated", "l1_nonlinear", "ahd", "sh3_min"}, {"light"});
  CHECK(value(rows, "zh3", "light", "change") > 0.1);
  CHECK(value(rows, "ahd", "light", "change") > 0.1);
  CHECK(value(rows, "l1_nonlinear", "light", "change") < 0.001);
  // Of two opposite suns l = 1 cancels: the mean of a sun's irradiance is left, 1/4, where facing one it is half of 1
  CHECK(value(rows, "l1_nonlinear", "light", "blend") == doctest::Approx(0.25).epsilon(1e-3));
  CHECK(value(rows, "sh3_min", "light", "blend") < 1e-12);
  for (std::size_t row = 0; row < rows.size(); ++row) CHECK(rows.at(row, "method") != Cell(std::string("sh3")));
}

TEST_CASE("rounding to half and to 8 bits is not amplified much by harmonics") {
  const Rows rows = measured({"sh3", "lightmap"}, {"storage"});
  for (const char* method : {"sh3", "lightmap"}) {
    CHECK(value(rows, method, "storage", "half") < 0x1p-10);
    CHECK(value(rows, method, "storage", "half") > 1e-5);
    CHECK(value(rows, method, "storage", "unorm8") < 0.01);
  }
}

TEST_CASE("rows do not depend on the number of threads") {
  const auto csv = [](int threads) {
    set_thread_count(threads);
    return measured({"sh2", "sh3_min", "octahedral", "h4"}, {}).csv();
  };
  const std::string one = csv(1);
  CHECK(csv(2) == one);
  set_thread_count(0);
}

TEST_CASE("what fails is told from what is poor") {
  Rows rows({"verdict"});
  CHECK_FALSE(stability_fails(rows));
  rows.add({Cell()});
  rows.add({Cell(std::string("poor"))});
  CHECK_FALSE(stability_fails(rows));
  rows.add({Cell(std::string("fails"))});
  CHECK(stability_fails(rows));
}

TEST_CASE("stability names what is wrong with what is asked for") {
  const auto message = [](const std::vector<std::string>& methods, const std::vector<std::string>& tests) {
    try {
      measured(methods, tests);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK(message({"sh33"}, {}).find("sh3") != std::string::npos);
  CHECK(message({"pca12"}, {}).find("is no basis") != std::string::npos);
  CHECK(message({"sh3"}, {"ring"}).find("ringing") != std::string::npos);
  CHECK(message({"cube"}, {"ringing"}).find("cube cannot be put to it") != std::string::npos);
  CHECK(message({"sh3"}, {"reading"}).find("of sphere maps") != std::string::npos);
}

}  // namespace twinshade
