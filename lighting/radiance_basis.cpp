#include "lighting/radiance_basis.h"

#include "base/portable_math.h"

namespace twinshade {

std::vector<double> radiance_basis(std::span<const glm::dvec3> directions) {
  static const TechniqueInfo& sh5 = find_technique("sh5");
  return basis_values(sh5, directions);
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
