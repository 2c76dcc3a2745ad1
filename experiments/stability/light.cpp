// Light: what methods do that are not linear in the light. blend: coefficients of two suns averaged, as a texture
// filter averages probes and texels, against the average of the two irradiances. change: two opposite suns, between
// whose directions there is nothing to choose, and a third that is a ten-thousandth as bright: how far irradiance
// differs with where that one is. Methods that are linear all the way have neither.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/directions.h"
#include "experiments/stability/test.h"

namespace twinshade {
namespace {

constexpr std::size_t kBlendedSuns = 16, kOpposedSuns = 8, kBlendNormals = 300;
constexpr double kFaintSun = 1e-4, kMostBlend = 0.05, kMostChange = 0.01;

bool is_linear(const TechniqueInfo& basis) {
  if (basis.projection == Projection::luma_chroma) return true;
  return basis.linear && basis.projection != Projection::nonnegative && basis.projection != Projection::window_minimum;
}

// Keeps what is worse.
void keep_worse(const std::vector<double>& values, const std::vector<double>& others, double peak,
                const std::vector<glm::dvec3>& normals, const std::string& what,
                const std::vector<double>& coefficients, Finding& worst) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = std::abs(values[i] - others[i]) / peak;
    if (!(error > worst.value)) continue;
    worst.value = error;
    worst.what = what;
    worst.normal = normals[i / 3];
    worst.coefficients = coefficients;
  }
}

Finding blend_finding(const TestedBasis& tested, const std::vector<glm::dvec3>& normals) {
  Finding worst;
  worst.test = "light";
  worst.measure = "blend";
  worst.unit = "of the peak";
  struct Lit {
    SmallLight light;
    std::vector<double> coefficients, irradiance;
  };
  std::vector<Lit> suns;
  for (std::size_t i = 0; i < 2 * kBlendedSuns; ++i) {
    const glm::dvec3 half = lattice_direction(i / 2, kBlendedSuns);  // and its opposite
    const glm::dvec3 sun = i % 2 == 0 ? half : -half;
    if (tested.hemisphere() && sun.z < 0) continue;
    Lit lit{unit_sun(to_float(sun)), {}, {}};
    lit.coefficients = tested.fit.coefficients(lit.light);
    lit.irradiance = tested.irradiance(Number::float64, lit.coefficients, normals);
    suns.push_back(std::move(lit));
  }
  const auto average = [](const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> mean;
    for (std::size_t i = 0; i < a.size(); ++i) mean.push_back((a[i] + b[i]) / 2);
    return mean;
  };
  for (std::size_t i = 0; i < suns.size(); ++i)
    for (std::size_t k = i + 1; k < suns.size(); ++k) {
      const std::vector<double> mean = average(suns[i].coefficients, suns[k].coefficients);
      keep_worse(tested.irradiance(Number::float64, mean, normals), average(suns[i].irradiance, suns[k].irradiance), 1,
                 normals, fmt::format("half of {}, half of {}", suns[i].light.name, suns[k].light.name), mean, worst);
    }
  worst.verdict = within(worst.value <= kMostBlend);
  return worst;
}

Finding change_finding(const TestedBasis& tested, const std::vector<glm::dvec3>& normals) {
  Finding worst;
  worst.test = "light";
  worst.measure = "change";
  worst.unit = "of the largest";
  for (std::size_t i = 0; i < kOpposedSuns; ++i) {
    const glm::dvec3 sun = to_float(lattice_direction(i, 2 * kOpposedSuns));
    const auto with = [&](const glm::dvec3& faint) {
      return tested.fit.coefficients({"", {}, {{sun}, {-sun}, {faint, glm::dvec3(kFaintSun)}}});
    };
    const std::vector<double> coefficients = with(sun);
    const std::vector<double> values = tested.irradiance(Number::float64, coefficients, normals);
    double peak = 0;
    for (const double value : values) peak = std::max(peak, std::abs(value));
    if (!(peak > 0)) continue;
    for (const glm::dvec3& faint : {-sun, tangents(sun)[0], tangents(sun)[1]})
      keep_worse(values, tested.irradiance(Number::float64, with(faint), normals), peak, normals,
                 fmt::format("{} and its opposite; 1e-4 more there or at ({:.3f}, {:.3f}, {:.3f})", unit_sun(sun).name,
                             faint.x, faint.y, faint.z),
                 coefficients, worst);
  }
  worst.verdict = within(worst.value <= kMostChange);
  return worst;
}

}  // namespace

std::vector<Finding> test_light(const TestedBasis& tested) {
  if (is_linear(tested.basis)) return {};
  const std::vector<glm::dvec3> normals = tested.normals(kBlendNormals);
  return {blend_finding(tested, normals), change_finding(tested, normals)};
}

}  // namespace twinshade
