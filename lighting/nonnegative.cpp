#include "lighting/nonnegative.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace twinshade {
namespace {

constexpr int kMost = 64;

// Solves G_PP s_P = m_P for the unknowns in `passive` by Cholesky.
void solve_passive(std::span<const double> gram, std::span<const double> moments, const int* passive, int count,
                   double* s) {
  const int n = int(moments.size());
  double factor[kMost * kMost];
  for (int i = 0; i < count; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = gram[std::size_t(passive[i]) * n + passive[j]];
      for (int k = 0; k < j; ++k) sum -= factor[i * kMost + k] * factor[j * kMost + k];
      factor[i * kMost + j] = i == j ? std::sqrt(sum) : sum / factor[j * kMost + j];
    }
  double y[kMost];
  for (int i = 0; i < count; ++i) {
    double sum = moments[passive[i]];
    for (int k = 0; k < i; ++k) sum -= factor[i * kMost + k] * y[k];
    y[i] = sum / factor[i * kMost + i];
  }
  for (int i = count - 1; i >= 0; --i) {
    double sum = y[i];
    for (int k = i + 1; k < count; ++k) sum -= factor[k * kMost + i] * s[passive[k]];
    s[passive[i]] = sum / factor[i * kMost + i];
  }
}

}  // namespace

void solve_nonnegative(std::span<const double> gram, std::span<const double> moments, std::span<double> x) {
  const int n = int(moments.size());
  TWINSHADE_CHECK_LE(n, kMost);
  TWINSHADE_CHECK_EQ(gram.size(), std::size_t(n) * n);
  TWINSHADE_CHECK_EQ(x.size(), std::size_t(n));
  std::fill(x.begin(), x.end(), 0.0);
  double largest = 0;
  for (const double m : moments) {
    if (!std::isfinite(m)) return;
    largest = std::max(largest, std::abs(m));
  }
  const double tolerance = 1e-13 * largest;

  bool is_passive[kMost] = {};
  for (int round = 0; round < 3 * n; ++round) {
    // The unknown at zero whose growth helps most
    int chosen = -1;
    double best = tolerance;
    for (int i = 0; i < n; ++i) {
      if (is_passive[i]) continue;
      double slope = moments[i];
      for (int k = 0; k < n; ++k) slope -= gram[std::size_t(i) * n + k] * x[k];
      if (slope > best) best = slope, chosen = i;
    }
    if (chosen < 0) return;
    is_passive[chosen] = true;

    // The fit without bounds of those that may move; on the way there the first to reach zero stays there
    for (;;) {
      int passive[kMost], count = 0;
      for (int i = 0; i < n; ++i)
        if (is_passive[i]) passive[count++] = i;
      double s[kMost] = {};
      solve_passive(gram, moments, passive, count, s);
      double step = 1;
      int blocking = -1;
      for (int k = 0; k < count; ++k) {
        const int i = passive[k];
        if (s[i] > 0) continue;
        const double reach = x[i] > 0 ? x[i] / (x[i] - s[i]) : 0;
        if (blocking < 0 || reach < step) step = reach, blocking = i;
      }
      for (int k = 0; k < count; ++k) {
        const int i = passive[k];
        x[i] = blocking < 0 ? s[i] : std::max(0.0, x[i] + step * (s[i] - x[i]));
      }
      if (blocking < 0) break;
      x[blocking] = 0;
      is_passive[blocking] = false;
    }
  }
}

}  // namespace twinshade
