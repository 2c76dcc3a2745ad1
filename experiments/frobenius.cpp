// How much of the spherical harmonics a basis holds: the Frobenius norm of I - B^T G^-1 B, where B holds the inner
// products of its functions with the harmonics and G is their Gram matrix (Iwanicki and Sloan, Ambient Dice, EGSR 2017,
// section 4.1). 0 where every harmonic up to the order lies in the span, sqrt(count) where none does. Integrals over
// the sphere; bases of the hemisphere have the condition number of their Gram matrix there, and no norm.
#include <Eigen/Cholesky>
#include <cmath>

#include "experiments/bases.h"
#include "experiments/chart.h"
#include "experiments/sphere_cells.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

constexpr int kLowestOrder = 2, kHighestOrder = 5;
constexpr int kCellPoints = 8, kHemisphereRings = 48;

std::string why_not(const TechniqueInfo& basis) {
  if (!basis.linear) return "it is not linear, so it has no Gram matrix";
  switch (basis.projection) {
    case Projection::least_squares:
    case Projection::truncation:
      return "";
    case Projection::value_at_normal:
      return "it holds one value and is not fitted";
    default:
      return "its functions are those of another basis; only how it is projected differs";
  }
}

// Norms for orders 2 to 5, the harmonics counted from the first.
std::vector<double> norms(const Matrix& residual) {
  std::vector<double> list;
  for (int order = kLowestOrder; order <= kHighestOrder; ++order) {
    double sum = 0;
    for (int i = 0; i < order * order; ++i)
      for (int k = 0; k < order * order; ++k) sum += residual(i, k) * residual(i, k);
    list.push_back(std::sqrt(sum));
  }
  return list;
}

}  // namespace

ExperimentResult run_frobenius(const ExperimentOptions& options) {
  const Quadrature sphere = sphere_cell_quadrature(kCellPoints);
  const Quadrature hemisphere = sphere_quadrature(0, kHemisphereRings);
  const Matrix harmonics = basis_matrix(find_technique("sh5"), sphere.directions);

  ExperimentResult result{Rows({"basis", "order", "norm", "condition"}), {}, {}};
  HeatMap map{"Frobenius norm of what a basis misses of spherical harmonics",
              "0: all of them lie in its span. Order n: l < n, counted from l = 0.",
              {},
              {"SH2", "SH3", "SH4", "SH5", "condition"},
              {},
              true};
  for (const TechniqueInfo* basis : chosen_bases(options, why_not)) {
    options.progress(std::string(basis->name));
    const Quadrature& points = is_hemispherical(*basis) ? hemisphere : sphere;
    const Matrix functions = basis_matrix(*basis, points.directions);
    const Matrix gram = weighted_product(functions, points.weights, functions);
    const double condition = condition_number(gram);
    if (is_hemispherical(*basis)) {
      result.rows.add({std::string(basis->name), Cell(), Cell(), condition});
      continue;
    }
    const Matrix products = weighted_product(functions, points.weights, harmonics);
    const Matrix residual = Matrix::Identity(harmonics.cols(), harmonics.cols()) -
                            products.transpose() * Matrix(gram.llt().solve(products));
    map.rows.emplace_back(basis->name);
    int order = kLowestOrder;
    for (const double norm : norms(residual)) {
      result.rows.add({std::string(basis->name), std::int64_t(order++), norm, condition});
      map.values.push_back(norm);
    }
    map.values.push_back(condition);
  }
  result.notes.push_back("bases of the hemisphere have no norm: the condition number is of their Gram matrix there");
  if (options.pictures && !map.rows.empty()) result.pictures.push_back({"frobenius", draw(map)});
  return result;
}

}  // namespace twinshade
