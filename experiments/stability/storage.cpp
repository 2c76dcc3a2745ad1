// Storage: how far irradiance is off when coefficients are rounded to half, or to 255 steps between the least and the
// greatest value that each number takes over some suns from all around and a constant light. Of the largest irradiance:
// of each light, or, since steps are as large for weak light, of all. A half is good to 2^-11 = 0.0005, 255 steps to
// 0.002 of their range: what is more is how much the method amplifies it.
#include <algorithm>
#include <cmath>

#include "experiments/stability/test.h"
#include "lighting/texel_storage.h"

namespace twinshade {
namespace {

constexpr std::size_t kStoredLights = 30, kStoredNormals = 400;

}  // namespace

std::vector<Finding> test_storage(const TestedBasis& tested) {
  std::vector<SmallLight> lights{{"constant light", glm::dvec3(1), {}}};
  for (const glm::dvec3& sun : tested.normals(kStoredLights)) lights.push_back(unit_sun(sun));
  const std::vector<glm::dvec3> normals = tested.normals(kStoredNormals);
  const std::size_t columns = std::size_t(tested.basis.count) * 3;
  std::vector<double> all;
  for (const SmallLight& light : lights)
    for (const double value : tested.fit.coefficients(light)) all.push_back(value);

  const auto row_of = [&](const auto& rows, std::size_t light) {
    return std::vector<double>(rows.begin() + std::ptrdiff_t(light * columns),
                               rows.begin() + std::ptrdiff_t((light + 1) * columns));
  };
  std::vector<std::vector<double>> exact;
  std::vector<double> peaks;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    exact.push_back(tested.irradiance(Number::float64, row_of(all, l), normals));
    peaks.push_back(0);
    for (const double value : exact.back()) peaks.back() = std::max(peaks.back(), std::abs(value));
  }
  const double highest = *std::max_element(peaks.begin(), peaks.end());
  std::vector<Finding> findings;
  for (const auto& [storage, most] : {std::pair{TexelStorage::half, 0.005}, std::pair{TexelStorage::unorm8, 0.02}}) {
    const std::vector<float> stored = through_storage(all, int(columns), storage);
    Finding worst;
    worst.test = "storage";
    worst.measure = texel_storage_name(storage);
    worst.unit = "of the largest";
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const std::vector<double> rounded = tested.irradiance(Number::float64, row_of(stored, l), normals);
      const double peak = storage == TexelStorage::unorm8 ? highest : peaks[l];
      if (!(peak > 0)) continue;
      for (std::size_t i = 0; i < rounded.size(); ++i) {
        const double error = std::abs(rounded[i] - exact[l][i]) / peak;
        if (!(error > worst.value)) continue;
        worst.value = error;
        worst.what = lights[l].name;
        worst.light = lights[l].suns.empty() ? std::nullopt : std::optional(lights[l].suns[0].direction);
        worst.normal = normals[i / 3];
        worst.coefficients = row_of(all, l);
      }
    }
    worst.verdict = within(worst.value <= most);
    findings.push_back(std::move(worst));
  }
  return findings;
}

}  // namespace twinshade
