// From one value to another: a + (b - a) t in the form that gives a and b exactly at t = 0 and 1.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace twinshade {

inline double mix(double a, double b, double t) { return a * (1 - t) + b * t; }
inline glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double t) { return a * (1 - t) + b * t; }

// 0 up to `low`, 1 from `high` on, a cubic without kinks between.
inline double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace twinshade
