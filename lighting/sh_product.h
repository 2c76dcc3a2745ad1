// Products of functions given by real SH, of order 1 to 6 (l < order, order^2 coefficients, conventions of
// shaders/basis/sh_functions.glsl).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace twinshade {

// The integral over the sphere of Y_i Y_j Y_k, i <= j <= k: the same for every permutation.
struct TripleProduct {
  std::uint8_t i, j, k;
  double value;
};

// All that are not zero, i, j, k < order^2, in ascending order. By exact quadrature of the functions' GLSL in double.
// NMV section 3.1: 25 at order 3.
const std::vector<TripleProduct>& sh_triple_products(int order);

// The matrix that multiplies by f: (f g)_j = sum over k of M[j * n + k] g_k, cut to n = order^2 coefficients.
// f: n values, `stride` apart. Symmetric.
std::vector<double> sh_product_matrix(std::span<const double> f, std::size_t stride, int order);

}  // namespace twinshade
