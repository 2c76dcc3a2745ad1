// Linear algebra of bases: Gram matrices, moments and operators between them. All matrices are row-major. Values of the
// functions come from the double translation of their GLSL, integrals from domain_quadrature.
#pragma once

#include <span>
#include <vector>

#include "lighting/registry.h"

namespace twinshade {

// All functions: UserError where a technique is no linear basis.

// Where a basis is fitted: its domain, the sphere for `either`.
Domain projection_domain(const TechniqueInfo& basis);

// [a.count][b.count]: integral of a_i b_j over the domain (`either`: the sphere).
std::vector<double> moment_matrix(const TechniqueInfo& a, const TechniqueInfo& b, Domain domain);
// moment_matrix(basis, basis): symmetric, positive definite.
std::vector<double> gram_matrix(const TechniqueInfo& basis, Domain domain);
inline std::vector<double> gram_matrix(const TechniqueInfo& basis) {
  return gram_matrix(basis, projection_domain(basis));
}

// Largest by smallest eigenvalue of a symmetric matrix [n][n]; infinite where the smallest is not positive.
double condition_number(std::span<const double> symmetric, int n);

// [to.count][from.count]: the least-squares fit of `to`'s functions to each of `from`'s over `domain`. SH to H over the
// hemisphere: EINM eq. 14 (T_h), for any l.
std::vector<double> basis_operator(const TechniqueInfo& from, const TechniqueInfo& to, Domain domain);
inline std::vector<double> basis_operator(const TechniqueInfo& from, const TechniqueInfo& to) {
  return basis_operator(from, to, projection_domain(to));
}

// [count][25] matrix of a linear basis of a linear projection: coefficient_b of irradiance = sum_j M[b][j] * radiance_j
// with radiance as real SH l <= 4 and A_l folded in (EINM eq. 7, with the inverse Gram matrix that bases which are not
// orthonormal need), as the registry's projection says. Radiance of l = 5 has no irradiance (A_5 = 0).
std::vector<double> operator_from_radiance(const TechniqueInfo& basis);

// Irradiance from radiance where both are in the same basis of the sphere: Iwanicki and Sloan, Ambient Dice, EGSR 2017,
// eq. 7. [count][count] matrices G^-1 C with C_ij the integral of b_i(n) max(0, n.w) b_j(w) over both spheres, which
// acts on coefficients of radiance, and G^-1 C G^-1, which acts on its raw moments (integrals of radiance times b_j):
// the paper's text leaves the second G^-1 out.
std::vector<double> irradiance_from_coefficients(const TechniqueInfo& basis);
std::vector<double> irradiance_from_moments(const TechniqueInfo& basis);

}  // namespace twinshade
