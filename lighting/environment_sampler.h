// Distant light, split for sampling: the excess of bright pixels (the sun, lamps, windows), each sample aimed at one of
// them, and the rest, looked up by rays that leave the scene. The two add up to the environment.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/environment.h"

namespace twinshade {

class EnvironmentSampler {
 public:
  explicit EnvironmentSampler(const Environment& environment);

  // Radiance of the rest towards a direction (any length, not zero).
  glm::vec3 rest(const glm::vec3& direction) const;

  bool has_bright() const { return !bright_.empty(); }
  std::size_t bright_count() const { return bright_.size(); }

  struct Sample {
    glm::dvec3 direction;  // unit, world space
    glm::dvec3 radiance;   // times solid angle, divided by the probability: the mean over samples is the integral
  };
  // u: [0, 1), which bright pixel; a, b: [0, 1), where in it. Pixels near each other have u near each other.
  Sample bright(double u, double a, double b) const;

 private:
  struct BrightPixel {
    double cumulative;  // power up to and including this one, of 1
    glm::dvec3 weighted_radiance;
    double longitude, sine_low;  // left edge, lower edge
    double longitude_width, sine_height;
  };
  std::vector<BrightPixel> bright_;
  std::uint32_t face_size_ = 0;
  std::vector<glm::vec3> faces_;  // +X -X +Y -Y +Z -Z, face_size_ squared each
};

}  // namespace twinshade
