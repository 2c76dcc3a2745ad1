// Quadrature of the whole sphere for functions made of smooth pieces: no cell lies across an edge of the icosahedron, a
// coordinate plane, or a great circle around an axis of the icosahedron, so the bases that are polynomials between
// those are integrated to about 1e-12.
#pragma once

#include "lighting/quadrature.h"

namespace twinshade {

// The sphere cut by the 15 mirror planes of the icosahedron with vertices (0, +-1, +-Phi) and its cyclic shifts (the
// coordinate planes are among them) and by the 6 planes perpendicular to its axes; points x points in each triangle.
Quadrature sphere_cell_quadrature(int points);

// Nodes and weights of Gauss-Legendre quadrature on [0, 1].
struct LineQuadrature {
  std::vector<double> nodes, weights;
};
LineQuadrature line_quadrature(int points);

}  // namespace twinshade
