#include "lighting/nonnegative.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "lighting/random.h"

namespace twinshade {
namespace {

double random_signed(std::uint64_t trial, std::uint64_t i) { return 2 * unit_real(random_bits(7, 0, trial, i)) - 1; }

TEST_CASE("non-negative least squares: feasible, stationary where positive, no descent where zero") {
  for (int trial = 0; trial < 500; ++trial) {
    const int n = 1 + trial % 12, rows = n + 3;
    std::vector<double> a(std::size_t(rows) * n), f(rows), gram(std::size_t(n) * n), moments(n), x(n);
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = random_signed(trial, i) + (trial % 3 == 0 ? 0.8 : 0);
    for (int r = 0; r < rows; ++r) f[r] = random_signed(trial, 1000 + r);
    for (int i = 0; i < n; ++i)
      for (int r = 0; r < rows; ++r) {
        moments[i] += a[r * n + i] * f[r];
        for (int k = 0; k < n; ++k) gram[i * n + k] += a[r * n + i] * a[r * n + k];
      }
    solve_nonnegative(gram, moments, x);
    CAPTURE(trial);
    for (int i = 0; i < n; ++i) {
      double slope = moments[i];
      for (int k = 0; k < n; ++k) slope -= gram[i * n + k] * x[k];
      CAPTURE(i);
      CHECK(x[i] >= 0);
      CHECK(slope < 1e-9);
      if (x[i] > 0) CHECK(std::abs(slope) < 1e-9);
    }
  }
}

TEST_CASE("non-negative least squares: nothing in, or no number in, nothing out") {
  const std::vector<double> gram = {2, 1, 1, 2};
  std::vector<double> x = {5, 5};
  solve_nonnegative(gram, std::vector<double>{0, 0}, x);
  CHECK(x == std::vector<double>{0, 0});
  solve_nonnegative(gram, std::vector<double>{NAN, 1}, x);
  CHECK(x == std::vector<double>{0, 0});
  solve_nonnegative(gram, std::vector<double>{-1, -2}, x);
  CHECK(x == std::vector<double>{0, 0});
}

}  // namespace
}  // namespace twinshade
