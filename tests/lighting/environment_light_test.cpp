#include "lighting/environment_light.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

using std::numbers::pi;

TEST_CASE("a constant environment: solid angles add up to the sphere, irradiance is pi L") {
  const Environment environment = uniform_environment(0.5f, 128);
  const std::vector<double> sh = environment_radiance(environment, 5);
  REQUIRE(sh.size() == 75);
  CHECK(sh[0] == doctest::Approx(0.5 * std::sqrt(4 * pi)).epsilon(1e-7));
  for (int i = 3; i < 75; ++i) CHECK(std::abs(sh[i]) < 1e-3);
  const glm::dvec3 normals[] = {{0, 1, 0}, {0.6, 0, 0.8}, {2.0 / 7, -3.0 / 7, 6.0 / 7}};
  for (const double e : environment_irradiance(environment, normals))
    CHECK(e == doctest::Approx(0.5 * pi).epsilon(1e-3));
}

TEST_CASE("a refined picture of one pixel is light from everywhere") {
  const Environment refined = refine_environment({"one", 1, 1, {glm::vec3(0.5f)}}, 64, 64);
  CHECK(environment_radiance(refined, 1)[0] == doctest::Approx(0.5 * std::sqrt(4 * pi)).epsilon(1e-7));
  const glm::dvec3 normals[] = {{0, 1, 0}, {0.6, 0, 0.8}};
  for (const double e : environment_irradiance(refined, normals)) CHECK(e == doctest::Approx(0.5 * pi).epsilon(1e-2));
}

TEST_CASE("one bright pixel: a light from its direction, of its solid angle") {
  Environment environment = uniform_environment(0, 64);
  environment.radiance[9 * 64 + 13] = glm::vec3(1, 2, 4);
  const glm::dvec3 d = environment.pixel_direction(13, 9);
  const double omega = environment.pixel_solid_angle(9);
  const glm::dvec3 normals[] = {d, -d};
  const std::vector<double> e = environment_irradiance(environment, normals);
  for (int c = 0; c < 3; ++c) {
    CHECK(e[c] == doctest::Approx(omega * (1 << c)).epsilon(1e-12));
    CHECK(e[3 + c] == 0);
  }
  const std::vector<double> sh = environment_radiance(environment, 2);
  CHECK(sh[3] == doctest::Approx(-std::sqrt(3 / (4 * pi)) * d.y * omega).epsilon(1e-6));
  CHECK(sh[6] == doctest::Approx(std::sqrt(3 / (4 * pi)) * d.z * omega).epsilon(1e-6));
  CHECK(sh[9] == doctest::Approx(-std::sqrt(3 / (4 * pi)) * d.x * omega).epsilon(1e-6));
}

TEST_CASE("integrals over an environment do not depend on threads") {
  Environment environment = uniform_environment(0.5f, 64);
  for (std::size_t i = 0; i < environment.radiance.size(); ++i) environment.radiance[i].g = float(i % 17);
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < 100; ++i) normals.push_back(environment.pixel_direction(std::uint32_t(i) % 64, 5));
  set_thread_count(1);
  const std::vector<double> sh = environment_radiance(environment, 3), e = environment_irradiance(environment, normals);
  set_thread_count(7);
  CHECK(environment_radiance(environment, 3) == sh);
  CHECK(environment_irradiance(environment, normals) == e);
  set_thread_count(0);
}

TEST_CASE("an environment of one pixel is a light from one direction; none, or one that is no light, is refused") {
  Environment environment = uniform_environment(1, 2);
  environment.width = environment.height = 1;
  environment.radiance.resize(1);
  CHECK(environment_radiance(environment, 2)[0] == doctest::Approx(std::sqrt(4 * pi)).epsilon(1e-6));
  const glm::dvec3 up(0, 1, 0), none(0), nan(std::nan(""), 0, 0);
  CHECK_THROWS_WITH_AS(environment_irradiance(environment, {&none, 1}), doctest::Contains("normal 0"), UserError);
  CHECK_THROWS_AS(environment_irradiance(environment, {&nan, 1}), UserError);
  for (const float bad : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    environment.radiance[0] = glm::vec3(1, bad, 1);
    CHECK_THROWS_WITH_AS(environment_radiance(environment, 3), doctest::Contains("pixel 0, 0"), UserError);
    CHECK_THROWS_AS(environment_irradiance(environment, {&up, 1}), UserError);
  }
  environment.radiance.clear();
  environment.width = environment.height = 0;
  CHECK_THROWS_AS(environment_radiance(environment, 3), UserError);
}

}  // namespace
}  // namespace twinshade
