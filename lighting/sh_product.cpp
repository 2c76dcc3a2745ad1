// Sloan, Stupid Spherical Harmonics (SH) Tricks, 2008, "product".
#include "lighting/sh_product.h"

#include <array>
#include <cmath>

#include "base/error.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

std::vector<TripleProduct> integrate(int order) {
  const int n = order * order;
  // The product of three functions has degree 3 (order - 1) at most
  const Quadrature points = sphere_quadrature(-1, 3 * order / 2 + 2);
  const std::vector<double> y = radiance_basis(points.directions, kHighestOrder * kHighestOrder);
  std::vector<TripleProduct> products;
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j)
      for (int k = j; k < n; ++k) {
        double sum = 0;
        for (std::size_t p = 0; p < points.weights.size(); ++p) {
          const double* at = y.data() + p * kHighestOrder * kHighestOrder;
          sum += points.weights[p] * at[i] * at[j] * at[k];
        }
        // The GLSL's constants have nine digits
        if (std::abs(sum) > 1e-7) products.push_back({std::uint8_t(i), std::uint8_t(j), std::uint8_t(k), sum});
      }
  return products;
}

}  // namespace

const std::vector<TripleProduct>& sh_triple_products(int order) {
  TWINSHADE_CHECK_LE(1, order);
  TWINSHADE_CHECK_LE(order, kHighestOrder);
  // Made once each; the indices of a lower order are a part of a higher one's
  static const std::array<std::vector<TripleProduct>, kHighestOrder> all = [] {
    std::array<std::vector<TripleProduct>, kHighestOrder> made;
    const std::vector<TripleProduct> most = integrate(kHighestOrder);
    for (int o = 1; o <= kHighestOrder; ++o)
      for (const TripleProduct& product : most)
        if (product.k < o * o) made[std::size_t(o - 1)].push_back(product);
    return made;
  }();
  return all[std::size_t(order - 1)];
}

std::vector<double> sh_product_matrix(std::span<const double> f, std::size_t stride, int order) {
  const std::size_t n = std::size_t(order) * std::size_t(order);
  TWINSHADE_CHECK_LE((n - 1) * stride + 1, f.size());
  std::vector<double> matrix(n * n, 0.0);
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k, double value) {
    matrix[j * n + k] += value * f[i * stride];
    if (j != k) matrix[k * n + j] += value * f[i * stride];
  };
  for (const auto& [i, j, k, value] : sh_triple_products(order)) {
    add(i, j, k, value);
    if (j != i) add(j, i, k, value);
    if (k != j) add(k, i, j, value);
  }
  return matrix;
}

}  // namespace twinshade
