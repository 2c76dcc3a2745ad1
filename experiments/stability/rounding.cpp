// Rounding: irradiance in float against the same shader in double, with the same inputs. In units of 2^-24, half of
// float's spacing at 1, of the light's largest irradiance. Branches that float takes differently show here, too.
#include <algorithm>
#include <cmath>

#include "experiments/stability/test.h"

namespace twinshade {
namespace {

constexpr std::size_t kRoundedNormals = 12000;
constexpr double kMostUnits = 64;

// What is shaded with: a constant, suns, a sky.
std::vector<SmallLight> rounding_lights() {
  const glm::dvec3 slanted = unit({2, 3, 6});
  return {{"constant light", glm::dvec3(1), {}},
          unit_sun({0, 0, 1}),
          unit_sun(slanted),
          unit_sun(unit({-5, 2, 1})),
          {"a blue sky, a red and a white sun",
           {0.2, 0.3, 0.6},
           {{slanted, glm::dvec3(1)}, {unit({-3, -4, 2}), {0.7, 0.2, 0.1}}}}};
}

}  // namespace

std::vector<Finding> test_rounding(const TestedBasis& tested) {
  std::vector<glm::dvec3> normals = tested.normals(kRoundedNormals);
  for (const TrickyNormal& tricky : tested.tricky)
    if (tricky.inside) normals.push_back(tricky.n);
  Finding worst{"rounding", "largest", 0, "2^-24", Verdict::ok, "", {}, {}, {}, {}};
  for (const SmallLight& light : rounding_lights()) {
    const std::vector<double> coefficients = tested.fit.coefficients(light);
    const std::vector<double> exact = tested.irradiance(Number::float64, coefficients, normals),
                              rounded = tested.irradiance(Number::scalar, coefficients, normals);
    double peak = 0;
    for (const double value : exact) peak = std::max(peak, std::abs(value));
    if (!(peak > 0)) continue;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double error = std::abs(rounded[i] - exact[i]) / peak * 0x1p24;
      if (!(error > worst.value)) continue;
      worst.value = error;
      worst.what = light.name;
      worst.normal = normals[i / 3];
      worst.light = light.suns.size() == 1 ? std::optional(light.suns[0].direction) : std::nullopt;
      worst.coefficients = coefficients;
    }
  }
  worst.verdict = within(worst.value <= kMostUnits);
  return {worst};
}

}  // namespace twinshade
