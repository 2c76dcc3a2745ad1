// A tangent for a normal that comes without one.
// T. Duff et al., Building an orthonormal basis, revisited, Journal of Computer Graphics Techniques 6(1), 2017.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace twinshade {

// Unit, orthogonal to the unit vector n; cross(n, it) completes the right-handed frame. Continuous but at n = (0, 0,
// -1).
inline glm::dvec3 orthonormal_tangent(const glm::dvec3& n) {
  const double sign = std::signbit(n.z) ? -1.0 : 1.0;
  const double a = -1.0 / (sign + n.z);
  return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

}  // namespace twinshade
