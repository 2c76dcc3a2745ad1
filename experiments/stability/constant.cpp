// What comes back of constant radiance, whose irradiance is 1 for every normal.
#include <cmath>

#include "experiments/stability/test.h"

namespace twinshade {
namespace {

constexpr std::size_t kConstantNormals = 20000;
constexpr double kMostOff = 0.01, kTie = 1e-6;

}  // namespace

std::vector<Finding> test_constant(const TestedBasis& tested) {
  const SmallLight light{"constant light", glm::dvec3(1), {}};
  const std::vector<double> coefficients = tested.fit.coefficients(light);
  std::vector<glm::dvec3> normals{{0, 0, 1}};
  for (const TrickyNormal& tricky : tested.tricky)
    if (tricky.inside) normals.push_back(tricky.n);
  for (const glm::dvec3& n : tested.normals(kConstantNormals)) normals.push_back(n);
  const std::vector<double> values = tested.irradiance(Number::float64, coefficients, normals);
  std::size_t low = 0, high = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!std::isfinite(values[i * 3])) {  // worse than any value
      low = high = i;
      break;
    }
    if (values[i * 3] < values[low * 3] - kTie) low = i;
    if (values[i * 3] > values[high * 3] + kTie) high = i;
  }
  std::vector<Finding> findings;
  for (const auto& [measure, at] : {std::pair{"least", low}, std::pair{"greatest", high}}) {
    const double value = values[at * 3];
    const Verdict verdict = judged(value, std::abs(value - 1) <= kMostOff);
    findings.push_back({"constant", measure, value, "of 1", verdict, light.name, {}, normals[at], {}, coefficients});
  }
  return findings;
}

}  // namespace twinshade
