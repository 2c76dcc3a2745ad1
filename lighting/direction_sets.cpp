// Each set is a Hammersley point set with Owen-scrambled second coordinate, jittered within its strata: one direction
// in each of `rays` bands of equal solid angle, and in every elementary interval of height times azimuth.
#include "lighting/direction_sets.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/portable_math.h"
#include "lighting/random.h"

namespace twinshade {

glm::dvec3 hemisphere_direction(double a, double b) {
  const double radius = std::sqrt(std::max(0.0, 1.0 - a * a));
  const double angle = 2 * portable::kPi * b;
  return {radius * portable::cos(angle), radius * portable::sin(angle), a};
}

DirectionSets::DirectionSets(std::uint32_t rays, std::uint64_t seed) : rays_(rays) {
  TWINSHADE_CHECK_LT(0u, rays);
  // As many sets as fit a few megabytes: neighbouring texels almost never share one.
  count_ = std::clamp<std::uint32_t>(65536u / rays, 16u, 4096u);
  const std::size_t total = std::size_t(count_) * rays_;
  directions_.reserve(total);
  for (std::uint32_t set = 0; set < count_; ++set) {
    const std::uint32_t scramble = std::uint32_t(random_bits(seed, 0, set));
    for (std::uint32_t ray = 0; ray < rays_; ++ray) {
      const double a = (ray + unit_real(random_bits(seed, 1, set, ray))) / rays_;
      const double b = scrambled_radical_inverse(ray, scramble) * 0x1p-32;
      directions_.push_back(hemisphere_direction(a, b));
    }
  }
  const std::vector<double> values = radiance_basis(directions_);
  weights_.assign(total * kWeights, 0.0f);
  for (std::size_t i = 0; i < total; ++i) {
    float* weights = weights_.data() + i * kWeights;
    for (int k = 0; k < kRadianceCount; ++k) weights[k] = float(values[i * kRadianceCount + k]);
    weights[kCosine] = float(directions_[i].z);
  }
}

}  // namespace twinshade
