// How much of the spherical harmonics a basis holds: the Frobenius norm of I - B^T G^-1 B, where B holds the inner
// products of its functions with the harmonics and G is their Gram matrix (Iwanicki and Sloan, Ambient Dice, EGSR 2017,
// section 4.1). 0 where every harmonic up to the order lies in the span, sqrt(count) where none does. Integrals over
// the sphere; bases of the hemisphere have the condition number of their Gram matrix there, and no norm.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "experiments/bases.h"
#include "experiments/chart.h"
#include "lighting/linear_bases.h"

namespace twinshade {
namespace {

constexpr int kLeastBands = 2, kMostBands = 5;

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
  for (int order = kLeastBands; order <= kMostBands; ++order) {
    double sum = 0;
    for (int i = 0; i < order * order; ++i)
      for (int k = 0; k < order * order; ++k) sum += residual(i, k) * residual(i, k);
    list.push_back(std::sqrt(sum));
  }
  return list;
}

}  // namespace

ExperimentResult run_frobenius(const ExperimentOptions& options) {
  const TechniqueInfo& harmonics = find_technique("sh5");
  // The harmonics' constants are floats, so their lengths are off by some 1e-8: more than the last digits of a small
  // norm.
  const std::vector<double> harmonics_gram = gram_matrix(harmonics, Domain::sphere);
  const Eigen::LLT<Matrix> lengths(Eigen::Map<const Matrix>(harmonics_gram.data(), harmonics.count, harmonics.count));
  ExperimentResult result{Rows({"basis", "order", "norm", "condition"}), {}, {}};
  HeatMap map{"Frobenius norm of what a basis misses of spherical harmonics",
              "0: all of them lie in its span. Order n: l < n, counted from l = 0.",
              {},
              {"SH2", "SH3", "SH4", "SH5", "condition"},
              {},
              true};
  const std::vector<const TechniqueInfo*> bases = chosen_bases(options, why_not);
  for (const TechniqueInfo* basis : bases) {
    options.progress(std::string(basis->name));
    const Domain domain = is_hemispherical(*basis) ? Domain::hemisphere : Domain::sphere;
    const std::vector<double> gram = gram_matrix(*basis, domain);
    const double condition = condition_number(gram, basis->count);
    if (domain == Domain::hemisphere) {
      result.rows.add({std::string(basis->name), Cell(), Cell(), number_cell(condition)});
      continue;
    }
    const std::vector<double> moments = moment_matrix(*basis, harmonics, Domain::sphere);
    const Matrix products =
        lengths.matrixL().solve(Eigen::Map<const Matrix>(moments.data(), basis->count, harmonics.count).transpose());
    const Matrix gram_part = Eigen::Map<const Matrix>(gram.data(), basis->count, basis->count);
    const Matrix residual = Matrix::Identity(harmonics.count, harmonics.count) -
                            products * Matrix(gram_part.llt().solve(products.transpose()));
    map.rows.emplace_back(basis->name);
    int order = kLeastBands;
    for (const double norm : norms(residual)) {
      result.rows.add({std::string(basis->name), std::int64_t(order++), norm, number_cell(condition)});
      map.values.push_back(norm);
    }
    map.values.push_back(condition);
  }
  if (std::any_of(bases.begin(), bases.end(), [](const TechniqueInfo* basis) { return is_hemispherical(*basis); }))
    result.notes.push_back("bases of the hemisphere have no norm: the condition number is of their Gram matrix there");
  if (options.pictures && !map.rows.empty()) result.pictures.push_back({"frobenius", draw(map)});
  return result;
}

}  // namespace twinshade
