// What comes back of constant radiance, whose irradiance is 1 for every normal.
#include <cmath>

#include "experiments/stability_test.h"

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
  for (std::size_t i = 1; i < normals.size(); ++i) {
    if (values[i * 3] < values[low * 3] - kTie) low = i;
    if (values[i * 3] > values[high * 3] + kTie) high = i;
  }
  std::vector<Finding> findings;
  for (const auto& [measure, at] : {std::pair{"least", low}, std::pair{"greatest", high}})
    findings.push_back({"constant",
                        measure,
                        values[at * 3],
                        "of 1",
                        within(std::abs(values[at * 3] - 1) <= kMostOff),
                        light.name,
                        {},
                        normals[at],
                        {},
                        coefficients});
  return findings;
}

}  // namespace twinshade
