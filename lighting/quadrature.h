// Points and weights that integrate polynomials of the direction exactly: Gauss-Legendre in z, evenly spaced in
// azimuth.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace twinshade {

struct Quadrature {
  std::vector<glm::dvec3> directions;
  std::vector<double> weights;  // their sum is the solid angle: 2 pi or 4 pi
};

// Exact for polynomials of degree < 2 * rings in z and < 2 * rings in azimuth. z from z_low to 1: 0 for the upper
// hemisphere, -1 for the sphere.
Quadrature sphere_quadrature(double z_low, int rings);

}  // namespace twinshade
