// Points and weights over the sphere and the hemisphere: one rule for polynomials of the direction, and those that
// bases are projected with, whose kinks and roots they take into account.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "lighting/registry.h"

namespace twinshade {

inline glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

struct Quadrature {
  std::vector<glm::dvec3> directions;
  std::vector<double> weights;  // their sum is the solid angle: 2 pi or 4 pi
};

// Exact for polynomials of degree < 2 * rings in z and < 2 * rings in azimuth. z from z_low to 1: 0 for the upper
// hemisphere, -1 for the sphere. Gauss-Legendre in z, evenly spaced in azimuth.
Quadrature sphere_quadrature(double z_low, int rings);

// The upper hemisphere, Gauss-Legendre in sqrt(z): exact for polynomials of degree < rings, and converging as fast for
// functions with half powers of z and 1 - z (Zernike, HSH, Makhotkin).
Quadrature hemisphere_quadrature(int rings);

// The twelve vertices of the icosahedron (0, +-Phi, +-1), (+-1, 0, +-Phi), (+-Phi, +-1, 0), on the unit sphere.
std::vector<glm::dvec3> icosahedron_vertices();

// The sphere in cells within which piecewise bases are smooth: no cell crosses an octant's border, an edge of the
// icosahedron, or the horizon of one of its vertices. Gauss-Legendre with points^2 points in each of the 240 cells,
// collapsed in the vertex or face centre, where a basis may depend on the side one comes from.
Quadrature icosahedral_quadrature(int points);

// What bases are projected with: hemisphere_quadrature for `hemisphere`, else icosahedral_quadrature. Made once.
const Quadrature& domain_quadrature(Domain domain);

}  // namespace twinshade
