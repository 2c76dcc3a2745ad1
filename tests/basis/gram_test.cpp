// Inner products: orthonormality, spans, and the table of condition numbers and Frobenius norms of Ambient Dice
// (Iwanicki and Sloan, EGSR 2017, table 1; its printed rows are running sums of these).
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/basis/support.h"
#include "tests/relative.h"

namespace twinshade::test {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Integrals of weight(direction) a_i b_j.
template <class Weight>
Matrix product_matrix(const char* a, const char* b, const Points& points, Weight weight) {
  const std::vector<double> va = values(a, points.directions), vb = values(b, points.directions);
  const Eigen::Index rows = Eigen::Index(points.weights.size());
  const Eigen::Map<const Matrix> fa(va.data(), rows, Eigen::Index(va.size()) / rows);
  const Eigen::Map<const Matrix> fb(vb.data(), rows, Eigen::Index(vb.size()) / rows);
  Eigen::VectorXd w(rows);
  for (Eigen::Index r = 0; r < rows; ++r) w[r] = points.weights[r] * weight(points.directions[r]);
  return fa.transpose() * w.asDiagonal() * fb;
}

Matrix product_matrix(const char* a, const char* b, const Points& points) {
  return product_matrix(a, b, points, [](const glm::dvec3&) { return 1.0; });
}

void check_identity(const char* basis, const Points& points) {
  CAPTURE(basis);
  const Matrix gram = product_matrix(basis, basis, points);
  CHECK((gram - Matrix::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff() < 1e-6);
}

double condition(const Matrix& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(gram)};
  return solver.eigenvalues().maxCoeff() / solver.eigenvalues().minCoeff();
}

// Real spherical harmonics with the factor (-1)^m by the recurrences of associated Legendre functions.
std::vector<double> legendre_harmonics(const glm::dvec3& n, int order) {
  std::vector<double> all(std::size_t(order) * order);
  const double radius = std::hypot(n.x, n.y), phi = std::atan2(n.y, n.x);
  for (int m = 0; m < order; ++m) {
    double previous = 0, value = 1;  // P_mm = (-1)^m (2m - 1)!! sin^m
    for (int k = 1; k <= m; ++k) value *= -(2 * k - 1) * radius;
    for (int l = m; l < order; ++l) {
      double k = (2 * l + 1) / (4 * kPi);
      for (int f = l - m + 1; f <= l + m; ++f) k /= f;
      const double scaled = std::sqrt(k) * value * (m == 0 ? 1 : std::sqrt(2.0));
      all[l * l + l + m] = scaled * std::cos(m * phi);
      if (m > 0) all[l * l + l - m] = scaled * std::sin(m * phi);
      const double next = ((2 * l + 1) * n.z * value - (l + m) * previous) / (l - m + 1);
      previous = value;
      value = next;
    }
  }
  return all;
}

}  // namespace

TEST_CASE("bases of the hemisphere are orthonormal there") {
  const Points points = rings(0, 64);  // Zernike's and HSH's are no polynomials
  for (const char* basis : {"hl2", "directional_occlusion", "h4", "h6", "h6_th2", "zernike3", "zernike6", "hsh4"})
    check_identity(basis, points);
  check_identity("hsh9", points);
}

TEST_CASE("spherical harmonics are orthonormal on the sphere") {
  const Points points = rings(-1, 16);
  for (const char* basis : {"sh2", "sh3", "sh4", "sh5", "sh6"}) check_identity(basis, points);
}

TEST_CASE("spherical harmonics l <= 5 are those of the Legendre recurrences, factor (-1)^m") {
  const Points points = rings(-1, 7);
  const std::vector<double> computed = values("sh6", points.directions);
  for (std::size_t r = 0; r < points.directions.size(); ++r) {
    const std::vector<double> expected = legendre_harmonics(points.directions[r], 6);
    for (std::size_t i = 0; i < 36; ++i) {
      CAPTURE(i);
      CAPTURE(hex(points.directions[r]));
      CHECK(std::abs(computed[r * 36 + i] - expected[i]) < 1e-6);
    }
  }
}

TEST_CASE("lower orders are the beginning of higher ones, bit for bit") {
  const Points points = rings(-1, 5);
  const std::vector<double> all = values("sh6", points.directions, Number::scalar);
  for (const char* basis :
       {"sh2", "sh3", "sh4", "sh5", "sh2_lsq", "sh3_lsq", "sh3_hanning", "sh3_lanczos", "sh3_min"}) {
    const std::vector<double> some = values(basis, points.directions, Number::scalar);
    const std::size_t count = some.size() / points.directions.size();
    for (std::size_t r = 0; r < points.directions.size(); ++r)
      for (std::size_t i = 0; i < count; ++i) CHECK(some[r * count + i] == all[r * 36 + i]);
  }
}

TEST_CASE("Makhotkin's functions are orthogonal for the weight z and span what HSH spans") {
  const Points points = rings(0, 64);
  for (const std::pair<const char*, const char*>& names : {std::pair("makhotkin4", "hsh4"), {"makhotkin9", "hsh9"}}) {
    const char *makhotkin = names.first, *hsh = names.second;
    CAPTURE(makhotkin);
    const Matrix weighted = product_matrix(makhotkin, makhotkin, points, [](const glm::dvec3& n) { return n.z; });
    for (Eigen::Index i = 0; i < weighted.rows(); ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        CHECK(std::abs(weighted(i, j)) < 1e-6 * std::sqrt(weighted(i, i) * weighted(j, j)));
    // Projecting on HSH, orthonormal, loses nothing of the norm
    const Matrix gram = product_matrix(makhotkin, makhotkin, points), cross = product_matrix(makhotkin, hsh, points);
    const Matrix projected = cross * cross.transpose();
    CHECK((gram - projected).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(condition(gram) < 200);  // they are independent
  }
}

TEST_CASE("condition numbers and Frobenius norms of I - B^T G^-1 B are those of the table") {
  struct Row {
    const char* basis;
    std::array<double, 4> norms;  // SH orders 2 to 5
    double condition;
  };
  const Row rows[] = {{"ambient_cube", {.1082532, 1.73543, 3.162279, 4.3589}, 2.5},
                      {"ad_linear_planar", {.003542313, .1844129, 2.00906, 3.606017}, 3.973},
                      {"ad_linear_spherical", {.001870961, .1544227, 2.006371, 3.605892}, 4.217},
                      {"ad_cos2cos4", {8.910936e-5, .02830032, 2.0002, 3.605551}, 13.04},
                      {"ad_cos2cos4_raw", {3.971024e-4, .01425998, 2.000052, 3.605552}, 16.04},
                      {"ad_cos2", {.002229458, .002229458, 2.000057, 3.605583}, 27.19},
                      {"ad_flat", {2.806231e-4, .003090632, .02786209, .1955406}, 363.3},
                      {"ad_spherical", {2.728352e-4, .001490093, .02772364, .1687397}, 203.8}};
  const Points points = icosahedral(6, 4);
  // The harmonics' constants are floats: their lengths are off by more than the last digits of a small norm.
  const Eigen::LLT<Matrix> lengths(product_matrix("sh5", "sh5", points));
  for (const Row& row : rows) {
    CAPTURE(row.basis);
    const Matrix gram = product_matrix(row.basis, row.basis, points),
                 moments = product_matrix(row.basis, "sh5", points);
    const Matrix unit = lengths.matrixL().solve(moments.transpose());
    const Matrix kept = unit * gram.llt().solve(unit.transpose());
    for (int order = 2; order <= 5; ++order) {
      const Matrix lost =
          Matrix::Identity(order * order, order * order) - kept.topLeftCorner(order * order, order * order);
      CAPTURE(order);
      CHECK(lost.norm() == relative(row.norms[order - 2], 1e-5));
    }
    CHECK(condition(gram) == relative(row.condition, 3e-4));
  }
}

}  // namespace twinshade::test
