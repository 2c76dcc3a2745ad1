// Least squares with no unknown below zero.
#pragma once

#include <span>

namespace twinshade {

// Minimises x^T G x - 2 m^T x over x >= 0: the fit of a signal with moments m = integral of b_i f to functions b_i with
// Gram matrix G. gram: [n][n], symmetric, positive definite; moments, x: n; n <= 64. Lawson and Hanson, Solving Least
// Squares Problems, 1974, chapter 23, on the normal equations (Bro and de Jong, 1997); ties go to the lowest index, so
// the result has the same bits everywhere. Moments that are not finite give zeros.
void solve_nonnegative(std::span<const double> gram, std::span<const double> moments, std::span<double> x);

}  // namespace twinshade
