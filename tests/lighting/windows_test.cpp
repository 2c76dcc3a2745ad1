#include "lighting/windows.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lighting/fit.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

using std::numbers::pi;

std::vector<glm::dvec3> dense(bool hemisphere) {
  std::vector<glm::dvec3> directions = sphere_quadrature(hemisphere ? 0 : -1, 60).directions;
  for (int i = 0; i < 720; ++i) directions.push_back({std::cos(pi * i / 360), std::sin(pi * i / 360), 0});
  return directions;
}

// Irradiance l <= 2 of a few suns, as [9 * 3].
std::vector<double> suns(int trial, int count, bool hemisphere) {
  std::vector<double> sh(27, 0.0);
  const double factors[] = {pi, 2 * pi / 3, pi / 4};
  for (int s = 0; s < count; ++s) {
    const auto random = [&](int i) { return unit_real(random_bits(3, trial, s, i)); };
    const double z = hemisphere ? random(0) : 2 * random(0) - 1, angle = 2 * pi * random(1);
    const glm::dvec3 d(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    const std::vector<double> y = basis_values(find_technique("sh3"), {&d, 1});
    for (int j = 0; j < 9; ++j)
      for (int c = 0; c < 3; ++c) sh[j * 3 + c] += y[j] * factors[j == 0 ? 0 : j < 4 ? 1 : 2] * random(2 + c);
  }
  return sh;
}

// Lowest value over all channels, by the shader's own functions, over the brightest channel's mean.
double lowest(const std::vector<double>& sh, const std::vector<double>& values) {
  double low = 1e300, scale = 0;
  for (int c = 0; c < 3; ++c) scale = std::max(scale, sh[c] * values[0]);
  for (std::size_t p = 0; p < values.size() / 9; ++p)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int j = 0; j < 9; ++j) sum += sh[j * 3 + c] * values[p * 9 + j];
      low = std::min(low, sum);
    }
  return low / scale;
}

TEST_CASE("window factors: in closed form") {
  CHECK(hanning_window()[1] == doctest::Approx(0.75).epsilon(1e-15));
  CHECK(hanning_window()[2] == doctest::Approx(0.25).epsilon(1e-15));
  CHECK(lanczos_window()[1] == doctest::Approx(std::sqrt(27.0) / (2 * pi)).epsilon(1e-15));
  CHECK(lanczos_window()[2] == doctest::Approx(std::sqrt(27.0) / (4 * pi)).epsilon(1e-15));
  CHECK(minimum_window(0) == BandFactors{1, 1, 1});
  CHECK(minimum_window(1.0 / 3)[1] == doctest::Approx(std::pow(std::sqrt(27.0) / (2 * pi), 4)).epsilon(1e-14));
}

TEST_CASE("the smallest window keeps irradiance from falling below zero, and is the smallest") {
  for (const bool hemisphere : {false, true}) {
    const MinimumWindow window(hemisphere ? Domain::hemisphere : Domain::sphere);
    const std::vector<double> values = basis_values(find_technique("sh3"), dense(hemisphere));
    int windowed = 0;
    for (int trial = 0; trial < 150; ++trial) {
      const std::vector<double> sh = suns(trial, 1 + trial % 5, hemisphere);
      const double strength = window.strength(sh.data());
      CAPTURE(hemisphere);
      CAPTURE(trial);
      CAPTURE(strength);
      std::vector<double> enough = sh, less = sh;
      apply_window(enough.data(), minimum_window(strength));
      CHECK(lowest(enough, values) >= -1e-11);
      CHECK(strength <= 1.0 / 3);
      if (strength == 0) continue;
      ++windowed;
      apply_window(less.data(), minimum_window(strength - 0.01));
      CHECK(lowest(less, values) < 0);
    }
    CHECK(windowed > 20);
  }
}

TEST_CASE(
    "the smallest window of light that is none: zero where there is nothing, the strongest where it is negative") {
  const MinimumWindow window(Domain::sphere);
  std::vector<double> sh(27, 0.0);
  CHECK(window.strength(sh.data()) == 0);
  sh[0] = sh[1] = sh[2] = 1;
  CHECK(window.strength(sh.data()) == 0);
  sh[1] = -1;
  CHECK(window.strength(sh.data()) == 1.0 / 3);
}

}  // namespace
}  // namespace twinshade
