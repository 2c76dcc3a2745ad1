#include "experiments/directions.h"

#include <cmath>

#include "base/portable_math.h"
#include "lighting/quadrature.h"

namespace twinshade {

using portable::kPi;

glm::dvec3 lattice_direction(std::size_t i, std::size_t count) {
  const double z = 1 - (2 * double(i) + 1) / double(count), radius = std::sqrt(1 - z * z);
  const double turns = double(i) * (std::sqrt(5.0) - 1) / 2, angle = 2 * kPi * (turns - std::floor(turns));
  return {radius * portable::cos(angle), radius * portable::sin(angle), z};
}

std::array<glm::dvec3, 2> tangents(const glm::dvec3& n) {
  const double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {glm::dvec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), glm::dvec3(b, sign + n.y * n.y * a, -n.y)};
}

std::array<glm::dvec3, 8> directions_around(const glm::dvec3& n, double step) {
  const auto [u, v] = tangents(n);
  std::array<glm::dvec3, 8> around;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * kPi / 4;
    around[std::size_t(k)] = unit(n + (u * portable::cos(angle) + v * portable::sin(angle)) * step);
  }
  return around;
}

glm::dvec3 to_float(const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); }

}  // namespace twinshade
