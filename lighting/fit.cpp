#include "lighting/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "lighting/irradiance_module.h"
#include "lighting/nonnegative.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1>;

// A Gram matrix this far from regular has functions that the directions cannot tell apart.
constexpr double kRegular = 1e-13;

Eigen::LLT<Matrix> factorise(const TechniqueInfo& basis, const Matrix& gram) {
  Eigen::LLT<Matrix> factors(gram);
  bool regular = factors.info() == Eigen::Success;
  for (int i = 0; regular && i < gram.rows(); ++i) {
    const double pivot = factors.matrixLLT()(i, i);
    regular = pivot * pivot > kRegular * gram(i, i);
  }
  if (!regular)
    throw UserError("basis " + std::string(basis.name) + ": the directions are too few to fit its " +
                    std::to_string(basis.count) + " coefficients");
  return factors;
}

// Each channel for itself.
class ChannelFit final : public MomentFit {
 public:
  ChannelFit(const TechniqueInfo& basis, std::span<const glm::dvec3> directions, std::span<const double> weights)
      : count_(basis.count), nonnegative_(basis.projection == Projection::nonnegative) {
    const std::vector<double> values = basis_values(basis, directions);
    weighted_ = values;
    Matrix gram = Matrix::Zero(count_, count_);
    for (std::size_t p = 0; p < weights.size(); ++p)
      for (int i = 0; i < count_; ++i) {
        double& weighted = weighted_[p * count_ + i];
        weighted *= weights[p];
        for (int k = 0; k <= i; ++k) gram(i, k) += weighted * values[p * count_ + k];
      }
    for (int i = 0; i < count_; ++i)
      for (int k = 0; k < i; ++k) gram(k, i) = gram(i, k);
    factors_ = factorise(basis, gram);
    gram_.assign(gram.data(), gram.data() + gram.size());
  }

  int moment_count() const override { return count_ * 3; }

  void moments(const double* samples, double* moments) const override {
    std::fill(moments, moments + moment_count(), 0.0);
    for (std::size_t p = 0; p < weighted_.size() / count_; ++p)
      for (int i = 0; i < count_; ++i)
        for (int c = 0; c < 3; ++c) moments[i * 3 + c] += weighted_[p * count_ + i] * samples[p * 3 + c];
  }

  void solve(const double* moments, double* coefficients) const override {
    Vector right(count_), x(count_);
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < count_; ++i) right(i) = moments[i * 3 + c];
      if (nonnegative_)
        solve_nonnegative(gram_, {right.data(), std::size_t(count_)}, {x.data(), std::size_t(count_)});
      else
        x = factors_.solve(right);
      for (int i = 0; i < count_; ++i) coefficients[i * 3 + c] = x(i);
    }
  }

 private:
  int count_;
  bool nonnegative_;
  std::vector<double> weighted_, gram_;
  Eigen::LLT<Matrix> factors_;
};

// Malvar and Sullivan, YCoCg-R: A Color Space with RGB Reversibility, 2003.
std::array<double, 3> to_ycocg(const double* rgb) {
  return {(rgb[0] + rgb[2]) / 4 + rgb[1] / 2, (rgb[0] - rgb[2]) / 2, rgb[1] / 2 - (rgb[0] + rgb[2]) / 4};
}

// All numbers of the coefficients at once: which of them mean luma, chroma or nothing is for the shader to say.
class LumaChromaFit final : public MomentFit {
 public:
  LumaChromaFit(const TechniqueInfo& basis, std::span<const glm::dvec3> directions, std::span<const double> weights)
      : count_(basis.count), points_(directions.size()) {
    // The response to one of each number, as YCoCg, where there is any: most numbers matter in few places
    const IrradianceModule module(basis, Number::float64);
    std::vector<std::vector<double>> responses;
    for (int scalar = 0; scalar < count_ * 3; ++scalar) {
      std::vector<double> response = module.run(
          points_, [&](std::size_t row) { return directions[row]; },
          [&](std::size_t, int i, int c) { return i * 3 + c == scalar ? 1.0 : 0.0; });
      std::vector<Entry> weighted;
      for (std::size_t p = 0; p < points_; ++p) {
        const std::array<double, 3> value = to_ycocg(response.data() + p * 3);
        for (std::size_t c = 0; c < 3; ++c) {
          response[p * 3 + c] = value[c];
          if (value[c] != 0) weighted.push_back({p * 3 + c, value[c] * weights[p]});
        }
      }
      if (weighted.empty()) continue;
      used_.push_back(scalar);
      weighted_.push_back(std::move(weighted));
      responses.push_back(std::move(response));
    }
    const int n = int(used_.size());
    Matrix gram(n, n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k <= i; ++k) gram(i, k) = gram(k, i) = product(weighted_[i], responses[k]);
    factors_ = factorise(basis, gram);
  }

  int moment_count() const override { return int(used_.size()); }

  void moments(const double* samples, double* moments) const override {
    std::vector<double> ycocg(points_ * 3);
    for (std::size_t p = 0; p < points_; ++p) {
      const std::array<double, 3> value = to_ycocg(samples + p * 3);
      std::copy(value.begin(), value.end(), ycocg.begin() + std::ptrdiff_t(p * 3));
    }
    for (std::size_t i = 0; i < used_.size(); ++i) moments[i] = product(weighted_[i], ycocg);
  }

  void solve(const double* moments, double* coefficients) const override {
    const Vector x = factors_.solve(Eigen::Map<const Vector>(moments, moment_count()));
    std::fill(coefficients, coefficients + count_ * 3, 0.0);
    for (std::size_t i = 0; i < used_.size(); ++i) coefficients[used_[i]] = x(Eigen::Index(i));
  }

 private:
  struct Entry {
    std::size_t place;  // point * 3 + channel of YCoCg
    double value;
  };
  static double product(const std::vector<Entry>& sparse, const std::vector<double>& dense) {
    double sum = 0;
    for (const Entry& entry : sparse) sum += entry.value * dense[entry.place];
    return sum;
  }

  int count_;
  std::size_t points_;
  std::vector<int> used_;                     // numbers that have any effect
  std::vector<std::vector<Entry>> weighted_;  // what each of them does, times the points' weights
  Eigen::LLT<Matrix> factors_;
};

class AmbientHighlightFit final : public SampleFit {
 public:
  AmbientHighlightFit(const TechniqueInfo& basis, std::span<const glm::dvec3> directions,
                      std::span<const double> weights)
      : module_(basis, Number::float64),
        directions_(directions.begin(), directions.end()),
        weights_(weights.begin(), weights.end()) {
    TWINSHADE_CHECK_EQ(basis.count, 3);
  }

  void solve(const double* samples, const double* radiance, double* coefficients) const override {
    // Red carries what the ambient colour does, green what the highlight does
    glm::dvec3 axis = luminance_axis(radiance);
    if (axis == glm::dvec3(0)) axis.z = 1;
    const std::vector<double> values = module_.run(
        directions_.size(), [&](std::size_t row) { return directions_[row]; },
        [&](std::size_t, int i, int c) { return i == 2   ? axis[c]
                                                : i == c ? 1.0
                                                         : 0.0; });
    double gram[4] = {}, moments[3][2] = {};
    for (std::size_t p = 0; p < directions_.size(); ++p) {
      const double f[2] = {values[p * 3], values[p * 3 + 1]};
      for (int i = 0; i < 2; ++i) {
        const double weighted = weights_[p] * f[i];
        for (int k = 0; k < 2; ++k) gram[i * 2 + k] += weighted * f[k];
        for (int c = 0; c < 3; ++c) moments[c][i] += weighted * samples[p * 3 + c];
      }
    }
    for (int c = 0; c < 3; ++c) {
      double x[2];
      solve_nonnegative(gram, moments[c], x);
      for (int i = 0; i < 2; ++i) coefficients[i * 3 + c] = x[i];
    }
    for (int c = 0; c < 3; ++c) coefficients[6 + c] = axis[c];
  }

 private:
  IrradianceModule module_;
  std::vector<glm::dvec3> directions_;
  std::vector<double> weights_;
};

}  // namespace

void MomentFit::solve(const double* samples, const double*, double* coefficients) const {
  std::vector<double> sums(static_cast<std::size_t>(moment_count()));
  moments(samples, sums.data());
  solve(sums.data(), coefficients);
}

std::unique_ptr<const MomentFit> make_moment_fit(const TechniqueInfo& basis, std::span<const glm::dvec3> directions,
                                                 std::span<const double> weights) {
  if (basis.projection == Projection::luma_chroma) return std::make_unique<LumaChromaFit>(basis, directions, weights);
  return std::make_unique<ChannelFit>(basis, directions, weights);
}

std::unique_ptr<const SampleFit> make_ambient_highlight_fit(const TechniqueInfo& basis,
                                                            std::span<const glm::dvec3> directions,
                                                            std::span<const double> weights) {
  return std::make_unique<AmbientHighlightFit>(basis, directions, weights);
}

glm::dvec3 luminance_axis(const double* sh) {
  // The functions of l = 1 are linear: their gradients are their values along the axes
  static const std::vector<double> values = [] {
    const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return basis_values(find_technique("sh2"), axes);
  }();
  glm::dvec3 axis(0);
  for (int j = 1; j < 4; ++j) {
    const double luminance = (0.2126 * sh[j * 3] + 0.7152 * sh[j * 3 + 1]) + 0.0722 * sh[j * 3 + 2];
    for (int k = 0; k < 3; ++k) axis[k] += luminance * values[k * 4 + j];
  }
  const double length = std::sqrt(glm::dot(axis, axis));
  return length > 0 && std::isfinite(length) ? axis / length : glm::dvec3(0);
}

void apply_window(double* sh, const BandFactors& factors) {
  for (int j = 0; j < 9; ++j)
    for (int c = 0; c < 3; ++c) sh[j * 3 + c] *= factors[j == 0 ? 0 : j < 4 ? 1 : 2];
}

}  // namespace twinshade
