#include "lighting/projection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <string>

#include "base/error.h"
#include "base/portable_math.h"
#include "lighting/fit.h"
#include "lighting/irradiance_module.h"
#include "lighting/linear_bases.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"
#include "lighting/windows.h"

namespace twinshade {

class Projector::Rule {
 public:
  virtual ~Rule() = default;
  virtual void project(const double* radiance, double* coefficients, std::size_t cells) const = 0;
};

namespace {

using SharedRule = std::shared_ptr<const Projector::Rule>;

// A row of a matrix without its zeros.
struct SparseRow {
  std::vector<int> columns;
  std::vector<double> values;
};

std::vector<SparseRow> sparse(const std::vector<double>& matrix, int rows, int columns) {
  std::vector<SparseRow> result(rows);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      if (const double value = matrix[std::size_t(i) * columns + j]; value != 0) {
        result[i].columns.push_back(j);
        result[i].values.push_back(value);
      }
  return result;
}

// Each channel by one matrix from radiance l <= 4.
class LinearRule final : public Projector::Rule {
 public:
  LinearRule(int radiance_count, int count, const std::vector<double>& matrix)
      : radiance_count_(radiance_count), count_(count), rows_(sparse(matrix, count, kRadianceCount)) {}

  void project(const double* radiance, double* coefficients, std::size_t cells) const override {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double* from = radiance + cell * radiance_count_ * 3;
      double* to = coefficients + cell * count_ * 3;
      for (const SparseRow& row : rows_) {
        double sum[3] = {};
        for (std::size_t k = 0; k < row.columns.size(); ++k)
          for (int c = 0; c < 3; ++c) sum[c] += row.values[k] * from[row.columns[k] * 3 + c];
        for (int c = 0; c < 3; ++c) *to++ = sum[c];
      }
    }
  }

 private:
  int radiance_count_, count_;
  std::vector<SparseRow> rows_;
};

// A linear rule, then something of each cell's coefficients.
class MinimumWindowRule final : public Projector::Rule {
 public:
  MinimumWindowRule(LinearRule truncated, Domain domain) : truncated_(std::move(truncated)), window_(domain) {}

  void project(const double* radiance, double* coefficients, std::size_t cells) const override {
    truncated_.project(radiance, coefficients, cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
      apply_window(coefficients + cell * 27, minimum_window(window_.strength(coefficients + cell * 27)));
  }

 private:
  LinearRule truncated_;
  MinimumWindow window_;
};

// What takes moments of irradiance over points: the fit of samples, fed with irradiance in closed form.
class SampledRule final : public Projector::Rule {
 public:
  SampledRule(int radiance_count, int count, std::unique_ptr<const SampleFit> fit,
              const std::vector<glm::dvec3>& directions)
      : radiance_count_(radiance_count), count_(count), fit_(std::move(fit)), points_(directions.size()) {
    const std::array<double, kMostRadianceCount> cosine = clamped_cosine_factors();
    irradiance_ = radiance_basis(directions);
    for (std::size_t p = 0; p < points_; ++p)
      for (int j = 0; j < kRadianceCount; ++j) irradiance_[p * kRadianceCount + j] *= cosine[j];
  }

  void project(const double* radiance, double* coefficients, std::size_t cells) const override {
    std::vector<double> samples(points_ * 3);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double* from = radiance + cell * radiance_count_ * 3;
      for (std::size_t p = 0; p < points_; ++p) {
        double sum[3] = {};
        for (int j = 0; j < kRadianceCount; ++j)
          for (int c = 0; c < 3; ++c) sum[c] += irradiance_[p * kRadianceCount + j] * from[j * 3 + c];
        for (int c = 0; c < 3; ++c) samples[p * 3 + c] = sum[c];
      }
      fit_->solve(samples.data(), from, coefficients + cell * count_ * 3);
    }
  }

 private:
  int radiance_count_, count_;
  std::unique_ptr<const SampleFit> fit_;
  std::size_t points_;
  std::vector<double> irradiance_;  // [point][25]: irradiance there of a unit of radiance
};

// What takes moments of irradiance, which are linear in radiance: [rows][25 * 3] for all channels together.
class MomentRule final : public Projector::Rule {
 public:
  MomentRule(int radiance_count, int count, std::unique_ptr<const MomentFit> fit,
             const std::vector<glm::dvec3>& directions)
      : radiance_count_(radiance_count), count_(count), fit_(std::move(fit)) {
    // Moments of each function of radiance in each channel, by those of its irradiance
    const std::array<double, kMostRadianceCount> cosine = clamped_cosine_factors();
    const std::vector<double> values = radiance_basis(directions);
    const int unknowns = fit_->moment_count(), columns = kRadianceCount * 3;
    std::vector<double> matrix(std::size_t(unknowns) * columns), samples(directions.size() * 3), moments(unknowns);
    for (int j = 0; j < kRadianceCount; ++j) {
      if (cosine[j] == 0) continue;
      for (int c = 0; c < 3; ++c) {
        std::fill(samples.begin(), samples.end(), 0.0);
        for (std::size_t p = 0; p < directions.size(); ++p)
          samples[p * 3 + c] = values[p * kRadianceCount + j] * cosine[j];
        fit_->moments(samples.data(), moments.data());
        for (int i = 0; i < unknowns; ++i) matrix[std::size_t(i) * columns + j * 3 + c] = moments[i];
      }
    }
    rows_ = sparse(matrix, unknowns, columns);
  }

  void project(const double* radiance, double* coefficients, std::size_t cells) const override {
    std::vector<double> moments(rows_.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double* from = radiance + cell * radiance_count_ * 3;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < rows_[i].columns.size(); ++k) sum += rows_[i].values[k] * from[rows_[i].columns[k]];
        moments[i] = sum;
      }
      fit_->solve(moments.data(), coefficients + cell * count_ * 3);
    }
  }

 private:
  int radiance_count_, count_;
  std::unique_ptr<const MomentFit> fit_;
  std::vector<SparseRow> rows_;
};

// The first four coefficients are irradiance l <= 1, the fifth that of the zonal harmonic l = 2 about its axis.
class ZonalRule final : public Projector::Rule {
 public:
  explicit ZonalRule(LinearRule truncated) : truncated_(std::move(truncated)) {}

  void project(const double* radiance, double* coefficients, std::size_t cells) const override {
    std::vector<double> sh3(cells * 27);
    truncated_.project(radiance, sh3.data(), cells);
    std::vector<glm::dvec3> axes(cells);
    for (std::size_t cell = 0; cell < cells; ++cell) axes[cell] = luminance_axis(sh3.data() + cell * 27);
    const std::vector<double> values = basis_values(find_technique("sh3"), axes);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double* from = sh3.data() + cell * 27;
      double* to = coefficients + cell * 15;
      std::copy(from, from + 12, to);
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int j = 4; j < 9; ++j) sum += from[j * 3 + c] * values[cell * 9 + j];
        to[12 + c] = axes[cell] == glm::dvec3(0) ? 0 : sum * std::sqrt(4 * portable::kPi / 5);
      }
    }
  }

 private:
  LinearRule truncated_;
};

// Irradiance in SH from radiance, l <= 4, `count` of them, each band times a factor.
std::vector<double> band_matrix(int count, const BandFactors& factors) {
  const std::array<double, kMostRadianceCount> cosine = clamped_cosine_factors();
  std::vector<double> matrix(std::size_t(count) * kRadianceCount, 0.0);
  for (int j = 0; j < count; ++j)
    matrix[std::size_t(j) * kRadianceCount + j] = cosine[j] * factors[j == 0 ? 0 : j < 4 ? 1 : 2];
  return matrix;
}

SharedRule make_rule(const TechniqueInfo& basis, int radiance_count) {
  const Domain domain = radiance_count == kRadianceCount ? Domain::hemisphere : Domain::sphere;
  const auto linear = [&](const std::vector<double>& matrix) {
    return LinearRule(radiance_count, int(matrix.size()) / kRadianceCount, matrix);
  };
  switch (basis.projection) {
    case Projection::least_squares:
    case Projection::truncation:
    case Projection::value_at_normal:
    case Projection::through_sh3:
      return std::make_shared<LinearRule>(linear(operator_from_radiance(basis)));
    case Projection::window_hanning:
    case Projection::window_lanczos: {
      TWINSHADE_CHECK_EQ(basis.count, 9);
      const bool hanning = basis.projection == Projection::window_hanning;
      return std::make_shared<LinearRule>(linear(band_matrix(9, hanning ? hanning_window() : lanczos_window())));
    }
    case Projection::window_minimum:
      TWINSHADE_CHECK_EQ(basis.count, 9);
      return std::make_shared<MinimumWindowRule>(linear(band_matrix(9, {1, 1, 1})), domain);
    case Projection::irradiance_sh2:
      TWINSHADE_CHECK_EQ(basis.count, 4);
      return std::make_shared<LinearRule>(linear(band_matrix(4, {1, 1, 1})));
    case Projection::zonal:
      TWINSHADE_CHECK_EQ(basis.count, 5);
      return std::make_shared<ZonalRule>(linear(band_matrix(9, {1, 1, 1})));
    case Projection::nonnegative:
    case Projection::luma_chroma: {
      // The shader is run once for each number of the coefficients: fewer points, exact to 1e-7 nevertheless
      const bool run = basis.projection == Projection::luma_chroma;
      const Quadrature points = run ? icosahedral_quadrature(5) : domain_quadrature(projection_domain(basis));
      return std::make_shared<MomentRule>(radiance_count, basis.count,
                                          make_moment_fit(basis, points.directions, points.weights), points.directions);
    }
    case Projection::ambient_highlight: {
      const Domain fitted = basis.domain == Domain::either ? domain : basis.domain;
      const Quadrature points =
          sphere_quadrature(fitted == Domain::hemisphere ? 0 : -1, fitted == Domain::hemisphere ? 8 : 16);
      return std::make_shared<SampledRule>(radiance_count, basis.count,
                                           make_ambient_highlight_fit(basis, points.directions, points.weights),
                                           points.directions);
    }
  }
  throw UserError("basis " + std::string(basis.name) + " has no projection");
}

// Once a process.
SharedRule rule_of(const TechniqueInfo& basis, int radiance_count) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, int>, SharedRule> rules;
  const std::pair<std::string, int> key(basis.name, radiance_count);
  {
    const std::lock_guard lock(mutex);
    if (const auto found = rules.find(key); found != rules.end()) return found->second;
  }
  const SharedRule rule = make_rule(basis, radiance_count);  // elsewhere, so that others can be made at the same time
  const std::lock_guard lock(mutex);
  return rules.emplace(key, rule).first->second;
}

}  // namespace

Projector::Projector(const TechniqueInfo& basis, int radiance_count) {
  if (!basis.is_basis)
    throw UserError("technique " + std::string(basis.name) + " is not a basis: nothing to project on");
  if (radiance_count != kRadianceCount && radiance_count != kMostRadianceCount)
    throw UserError("radiance has 25 or 36 coefficients, not " + std::to_string(radiance_count));
  rule_ = rule_of(basis, radiance_count);
}

Projector::~Projector() = default;
Projector::Projector(Projector&&) noexcept = default;
Projector& Projector::operator=(Projector&&) noexcept = default;

void Projector::project(const double* radiance, double* coefficients) const {
  rule_->project(radiance, coefficients, 1);
}

void Projector::project(const double* radiance, double* coefficients, std::size_t cells) const {
  rule_->project(radiance, coefficients, cells);
}

std::vector<double> reconstruct(const TechniqueInfo& basis, std::span<const double> coefficients,
                                std::span<const glm::dvec3> directions, Number number) {
  const IrradianceModule module(basis, number);
  TWINSHADE_CHECK_EQ(coefficients.size(), std::size_t(basis.count) * 3);
  return module.run(
      directions.size(), [&](std::size_t row) { return directions[row]; },
      [&](std::size_t, int i, int c) { return coefficients[std::size_t(i) * 3 + c]; });
}

}  // namespace twinshade
