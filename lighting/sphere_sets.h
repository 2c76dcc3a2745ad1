// Stratified directions of the whole sphere and the visibility basis towards them, as a fixed number of sets from which
// each texel or vertex takes one, so that the basis is evaluated once a direction and not once a ray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace twinshade {

class SphereSets {
 public:
  // rays: directions in a set, at least 1.
  SphereSets(std::uint32_t rays, std::uint64_t seed);

  // The set that a cell takes.
  std::uint32_t set_of(std::uint32_t cell) const;
  const glm::vec3* directions(std::uint32_t set) const { return directions_.data() + std::size_t(set) * rays_; }
  // kVisibilityCount floats a ray.
  const float* values(std::uint32_t set) const;
  std::size_t bytes() const { return directions_.size() * sizeof(glm::vec3) + values_.size() * sizeof(float); }

 private:
  std::uint32_t rays_, count_;
  std::uint64_t seed_;
  std::vector<glm::vec3> directions_;
  std::vector<float> values_;
};

}  // namespace twinshade
