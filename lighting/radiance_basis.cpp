#include "lighting/radiance_basis.h"

#include "base/error.h"
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

const TechniqueInfo& radiance_technique(int count) {
  for (int order = 2; order <= 6; ++order)
    if (order * order == count) return find_technique("sh" + std::to_string(order));
  throw UserError("radiance has 4, 9, 16, 25 or 36 coefficients, not " + std::to_string(count));
}

std::vector<double> radiance_basis(std::span<const glm::dvec3> directions, int count) {
  // Found once: this is called for every few texels
  static const auto load = [](int n) {
    return &load_module(basis_values_source(radiance_technique(n)), Number::float64);
  };
  static const ShaderModule* const lightmap = load(kRadianceCount);
  static const ShaderModule* const volume = load(kVolumeRadianceCount);
  const ShaderModule& module = count == kRadianceCount         ? *lightmap
                               : count == kVolumeRadianceCount ? *volume
                                                               : *load(count);
  const std::size_t rows = directions.size();
  std::vector<double> inputs(rows * 3);
  for (std::size_t i = 0; i < rows; ++i)
    for (int c = 0; c < 3; ++c) inputs[c * rows + i] = directions[i][c];
  const std::vector<double> columns = run_module(module, Number::float64, inputs, rows);
  std::vector<double> values(rows * count);
  for (std::size_t k = 0; k < std::size_t(count); ++k)
    for (std::size_t i = 0; i < rows; ++i) values[i * count + k] = columns[k * rows + i];
  return values;
}

std::string radiance_basis_hash(int count) { return source_hash(basis_values_source(radiance_technique(count))); }

std::array<double, kMostRadianceCount> clamped_cosine_factors() {
  constexpr double pi = portable::kPi;
  constexpr double band[] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24, 0};
  std::array<double, kMostRadianceCount> factors{};
  for (int l = 0, j = 0; l <= 5; ++l)
    for (int m = -l; m <= l; ++m) factors[j++] = band[l];
  return factors;
}

}  // namespace twinshade
