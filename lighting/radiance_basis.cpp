#include "lighting/radiance_basis.h"

#include "base/portable_math.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"

namespace twinshade {

std::vector<double> basis_values(const TechniqueInfo& basis, std::span<const glm::dvec3> directions) {
  std::vector<double> triples;
  triples.reserve(directions.size() * 3);
  for (const glm::dvec3& d : directions) triples.insert(triples.end(), {d.x, d.y, d.z});
  return evaluate_basis(basis.name, triples);
}

std::vector<double> radiance_basis(std::span<const glm::dvec3> directions) {
  // Found once: this is called for every few texels
  static const ShaderModule& module = load_module(basis_values_source(find_technique("sh5")), Number::float64);
  const std::size_t rows = directions.size();
  std::vector<double> inputs(rows * 3);
  for (std::size_t i = 0; i < rows; ++i)
    for (int c = 0; c < 3; ++c) inputs[c * rows + i] = directions[i][c];
  const std::vector<double> columns = run_module(module, Number::float64, inputs, rows);
  std::vector<double> values(rows * kRadianceCount);
  for (std::size_t k = 0; k < kRadianceCount; ++k)
    for (std::size_t i = 0; i < rows; ++i) values[i * kRadianceCount + k] = columns[k * rows + i];
  return values;
}

std::array<double, kRadianceCount> clamped_cosine_factors() {
  constexpr double pi = portable::kPi;
  constexpr double band[] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24};
  std::array<double, kRadianceCount> factors{};
  for (int l = 0, j = 0; l <= 4; ++l)
    for (int m = -l; m <= l; ++m) factors[j++] = band[l];
  return factors;
}

}  // namespace twinshade
