// Figure 8 of Iwanicki and Sloan, Ambient Dice, EGSR 2017, on its Ennis probe, with noise-free irradiance.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>

#include <unistd.h>

#include "base/error.h"
#include "base/parallel.h"
#include "experiments/probe_light.h"
#include "images/image_file.h"
#include "lighting/environment_light.h"
#include "lighting/projection.h"

using namespace twinshade;

namespace {

const std::map<std::string, double> kEnnis = {
    {"sh2", .5588988},          {"sh3", .09447616},         {"sh5", .02793375},
    {"ambient_cube", .3949675}, {"ad_cos2cos4", .08953798}, {"ad_cos2cos4_raw", .08820194},
    {"ad_ycocg", .04115217},    {"ad_flat", .03470994},     {"ad_spherical", .03948151},
};

Environment environment_of(std::uint32_t width, std::uint32_t height, glm::vec3 radiance) {
  Environment environment;
  environment.name = "test";
  environment.width = width;
  environment.height = height;
  environment.radiance.assign(std::size_t(width) * height, radiance);
  return environment;
}

}  // namespace

TEST_CASE("errors on the Ennis probe") {
  const std::string probe = std::string(TWINSHADE_SOURCE_DIR) + "/../shared/probes/ennis.hdr";
  if (!std::filesystem::exists(probe)) {
    MESSAGE("skipped: " << probe << " is not there");
    return;
  }
  // As many normals as the experiment takes where time does not matter: TWINSHADE_SLOW_TESTS is set for that label.
  const bool slow = std::getenv("TWINSHADE_SLOW_TESTS");
  const ProbeLight light = measured_light({"ennis", load_environment(probe)}, slow ? 14 : 7);
  int met = 0;
  for (const TechniqueInfo& basis : techniques()) {
    const auto found = kEnnis.find(std::string(basis.name));
    if (found == kEnnis.end()) continue;
    CAPTURE(basis.name);
    const ProbeError error = probe_error(light, reconstruct(basis, fitted_coefficients(basis, light), light.normals));
    CHECK(std::abs(error.rmse / found->second - 1) < (slow ? 1e-5 : 4e-5));
    ++met;
  }
  CHECK(met >= 3);
}

TEST_CASE("errors on a probe are the same on one, two and seven threads") {
  std::vector<double> errors[3];
  for (int k = 0; k < 3; ++k) {
    set_thread_count(k == 0 ? 1 : k == 1 ? 2 : 7);
    Environment environment = environment_of(32, 16, glm::vec3(0.5f, 1, 2));
    environment.radiance[100] = glm::vec3(900, 700, 300);
    const ProbeLight light = measured_light({"sun", environment}, 4);
    for (const TechniqueInfo& basis : techniques()) {
      if (!basis.is_basis || !why_not_spherical(basis).empty()) continue;
      const ProbeError error = probe_error(light, reconstruct(basis, fitted_coefficients(basis, light), light.normals));
      errors[k].insert(errors[k].end(), {error.rmse, error.relative});
    }
  }
  set_thread_count(0);
  CHECK(errors[0] == errors[1]);
  CHECK(errors[0] == errors[2]);
}

TEST_CASE("rows and pictures of an experiment with a probe") {
  ExperimentOptions options;
  options.probes = {"constant"};
  options.bases = {"sh2"};
  options.relative = true;
  const ExperimentResult result = run_probe_rmse(options);
  CHECK(result.rows.columns() == std::vector<std::string>{"basis", "probe", "rmse", "relative"});
  REQUIRE(result.rows.size() == 1);
  CHECK(std::get<std::string>(result.rows.at(0, "probe")) == "constant");
  CHECK(result.pictures.size() == 3);
}

TEST_CASE("one light is the same to an experiment however small its picture is") {
  // The upper half sky, stored in one size and another; finer than this no picture is refined
  const auto write = [](const std::string& name, std::uint32_t width, std::uint32_t height) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
    std::vector<float> rgb(std::size_t(width) * height * 3, 0.25f);
    std::fill(rgb.begin(), rgb.begin() + std::ptrdiff_t(rgb.size() / 2), 1.0f);
    write_image_file(path.string(), {width, height, 3, true, rgb.data(), std::ptrdiff_t(width) * 12, {}});
    return path.string();
  };
  ExperimentOptions options;
  const std::string process = std::to_string(::getpid());
  options.probes = {write("twinshade_small_" + process + ".exr", 8, 4),
                    write("twinshade_odd_" + process + ".exr", 20, 66), "constant"};
  std::vector<double> errors;
  for (const Probe& probe : load_probes(options)) {
    const ProbeLight light = measured_light(probe, 4);
    const TechniqueInfo& sh3 = find_technique("sh3");
    errors.push_back(probe_error(light, reconstruct(sh3, fitted_coefficients(sh3, light), light.normals)).rmse);
  }
  std::filesystem::remove(options.probes[0]);
  std::filesystem::remove(options.probes[1]);
  CHECK(std::abs(errors[0] - errors[1]) < 3e-6);
  CHECK(errors[2] < 2e-6);
}

TEST_CASE("a probe of one pixel is one light, as far off as one light is") {
  // A pixel in the middle of the picture is light from the front alone.
  const ProbeLight light = measured_light({"pixel", environment_of(1, 1, glm::vec3(2))});
  const TechniqueInfo& sh3 = find_technique("sh3");
  const ProbeError error = probe_error(light, reconstruct(sh3, fitted_coefficients(sh3, light), light.normals));
  // 4 pi * 2 from one direction, over pi; truncating max(0, cos) to l <= 2 leaves pi/192 of its square over the sphere
  const double pi = std::acos(-1.0), missing = 2 * pi / 3 - (pi / 4 + pi / 3 + 5 * pi / 64);
  CHECK(error.rmse == doctest::Approx(8 * std::sqrt(missing / (4 * pi))).epsilon(1e-3));
  CHECK(error.relative == doctest::Approx(std::sqrt(missing / (2 * pi / 3))).epsilon(1e-3));
}

TEST_CASE("a probe without light: no error, and none relative to it") {
  const ProbeLight light = measured_light({"dark", environment_of(4, 2, glm::vec3(0))}, 4);
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis || !why_not_spherical(basis).empty()) continue;
    CAPTURE(basis.name);
    const ProbeError error = probe_error(light, reconstruct(basis, fitted_coefficients(basis, light), light.normals));
    CHECK(error.rmse == 0);
    CHECK(std::isnan(error.relative));
  }
  CHECK(display_scale(light) == 1);
}

TEST_CASE("negative and infinite radiance are refused by name") {
  for (const float bad : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    Environment environment = environment_of(8, 4, glm::vec3(1));
    environment.radiance[9].g = bad;
    CHECK_THROWS_WITH_AS(measured_light({"bad", environment}), doctest::Contains("1, 1"), UserError);
  }
}

TEST_CASE("bases of the hemisphere are refused for probes") {
  ExperimentOptions options;
  options.bases = {"h4"};
  CHECK_THROWS_WITH_AS(run_probe_rmse(options), doctest::Contains("hemisphere"), UserError);
  CHECK_THROWS_WITH_AS(run_wobble(options), doctest::Contains("hemisphere"), UserError);
}
