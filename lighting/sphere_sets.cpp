// A set has one direction in each of `rays` bands of equal solid angle, evenly over azimuth: a Hammersley point set
// with Owen-scrambled second coordinate, jittered along z.
#include "lighting/sphere_sets.h"

#include <algorithm>

#include "lighting/direction_sets.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"
#include "lighting/visibility_bake.h"

namespace twinshade {

SphereSets::SphereSets(std::uint32_t rays, std::uint64_t seed) : rays_(rays), seed_(seed) {
  // As many sets as fit a few megabytes: neighbouring texels almost never share one.
  count_ = std::clamp<std::uint32_t>(65536u / rays, 16u, 4096u);
  std::vector<glm::dvec3> exact;
  exact.reserve(std::size_t(count_) * rays);
  for (std::uint32_t set = 0; set < count_; ++set) {
    const std::uint32_t scramble = std::uint32_t(random_bits(seed, kSphereScramble, set));
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
      const double a = (ray + unit_real(random_bits(seed, kSphereJitter, set, ray))) / rays;
      exact.push_back(hemisphere_direction(1 - 2 * a, scrambled_radical_inverse(ray, scramble) * 0x1p-32));
    }
  }
  const std::vector<double> values = radiance_basis(exact, kVisibilityCount);
  directions_.assign(exact.begin(), exact.end());
  values_.assign(values.begin(), values.end());
}

std::uint32_t SphereSets::set_of(std::uint32_t cell) const {
  return std::uint32_t(random_bits(seed_, kSphereSet, cell) % count_);
}

const float* SphereSets::values(std::uint32_t set) const {
  return values_.data() + std::size_t(set) * rays_ * kVisibilityCount;
}

}  // namespace twinshade
