// Stratified directions of the upper hemisphere, uniform in solid angle, as a fixed number of sets from which each
// texel takes one, so that the basis is evaluated once a direction and not once a ray.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lighting/radiance_basis.h"

namespace twinshade {

class DirectionSets {
 public:
  // rays: directions in a set, at least 1.
  DirectionSets(std::uint32_t rays, std::uint64_t seed);

  // What is multiplied with a ray's radiance and summed: the 25 basis values, the cosine, and padding.
  static constexpr int kWeights = 28;
  static constexpr int kCosine = kRadianceCount;

  std::uint32_t rays() const { return rays_; }
  std::uint32_t count() const { return count_; }
  const glm::dvec3* directions(std::uint32_t set) const { return directions_.data() + std::size_t(set) * rays_; }
  // kWeights floats a ray.
  const float* weights(std::uint32_t set) const { return weights_.data() + std::size_t(set) * rays_ * kWeights; }

 private:
  std::uint32_t rays_, count_;
  std::vector<glm::dvec3> directions_;
  std::vector<float> weights_;
};

// The point (a, b) of the unit square as a direction with z = a.
glm::dvec3 hemisphere_direction(double a, double b);

}  // namespace twinshade
