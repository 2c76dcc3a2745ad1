// The integrated mean squared error of hemispherical bases (Habel and Wimmer, Efficient Irradiance Normal Mapping, I3D
// 2010, figure 3): the integral over the upper hemisphere of (approximation - E)^2, for one unit impulse in expectation
// (S1), for random sums of impulses (S2) and for random spherical harmonics (S3); and for a single sun at each
// elevation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "experiments/chart.h"
#include "experiments/hemisphere_fit.h"

namespace twinshade {
namespace {

constexpr int kPublishedSignals = 10000;
constexpr std::size_t kBlock = 100;  // signals at a time
constexpr int kSignalRings = 24, kElevationStep = 5;

struct Mean {
  double value = 0, standard_error = 0;  // NaN: of one value there is none
};

// Expectation over the impulses.
double impulse_error(const HemisphereFit& fit, const Impulses& impulses) {
  const std::vector<ImpulseFit> fits = fit_impulses(fit, impulses);
  double expectation = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) expectation += impulses.weights[i] * fits[i].squared_error;
  return expectation;
}

// The residual itself is integrated: differences of squares would cancel.
std::vector<double> block_errors(const HemisphereFit& fit, const SignalBlock& block,
                                 const std::vector<double>& weights) {
  const Matrix coefficients = fit.coefficients(block);
  const Eigen::Index signals = block.irradiance.cols();
  std::vector<double> errors(std::size_t(signals), 0.0), residual(errors.size());
  for (Eigen::Index p = 0; p < block.irradiance.rows(); ++p) {
    for (Eigen::Index s = 0; s < signals; ++s) residual[std::size_t(s)] = -block.irradiance(p, s);
    for (Eigen::Index i = 0; i < coefficients.rows(); ++i) {
      const double value = fit.functions()(p, i);
      for (Eigen::Index s = 0; s < signals; ++s) residual[std::size_t(s)] += value * coefficients(i, s);
    }
    for (std::size_t s = 0; s < errors.size(); ++s) errors[s] += weights[std::size_t(p)] * residual[s] * residual[s];
  }
  return errors;
}

Mean mean_of(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double count = double(values.size()), mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean,
          values.size() > 1 ? std::sqrt(squares / (count - 1) / count) : std::numeric_limits<double>::quiet_NaN()};
}

// Of each fit, over random signals of one kind. Blocks are independent and land in their own places.
std::vector<Mean> random_errors(SignalKind kind, const std::vector<HemisphereFit>& fits, const Quadrature& points,
                                const ExperimentOptions& options) {
  const std::size_t total = std::size_t(options.samples > 0 ? options.samples : kPublishedSignals);
  const Matrix radiance = basis_matrix(find_technique("sh5"), points.directions);
  std::vector<std::vector<double>> errors(fits.size(), std::vector<double>(total));
  parallel_for((total + kBlock - 1) / kBlock, [&](std::size_t b, int) {
    const std::size_t first = b * kBlock, count = std::min(kBlock, total - first);
    const SignalBlock block = random_signals(kind, options.seed, first, count, points.directions, radiance);
    for (std::size_t f = 0; f < fits.size(); ++f) {
      const std::vector<double> part = block_errors(fits[f], block, points.weights);
      std::copy(part.begin(), part.end(), errors[f].begin() + std::ptrdiff_t(first));
    }
  });
  std::vector<Mean> means;
  for (const std::vector<double>& list : errors) means.push_back(mean_of(list));
  return means;
}

Drawing error_chart(const std::vector<HemisphereFit>& fits, const std::vector<std::vector<Mean>>& signals,
                    const std::vector<std::string>& labels) {
  BarChart chart;
  chart.title = "Error of hemispherical irradiance bases";
  chart.subtitle = "S1: one impulse (expectation); S2: 16 impulses; S3: random SH. S2 and S3: means of random signals.";
  chart.value.title = "IMSE: integral of the squared error over the hemisphere, irradiance² sr";
  chart.value.logarithmic = true;
  chart.value.low = 1e-3;  // sh5 holds S3 exactly
  std::vector<std::size_t> order(fits.size());
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return signals[0][a].value > signals[0][b].value; });
  for (const std::size_t f : order)
    chart.rows.push_back(fmt::format("{} ({})", fits[f].basis().name, fits[f].basis().count));
  for (std::size_t s = 0; s < signals.size(); ++s) {
    chart.bars.push_back({labels[s], {}});
    for (const std::size_t f : order) chart.bars.back().values.push_back(signals[s][f].value);
  }
  return draw(chart);
}

}  // namespace

ExperimentResult run_basis_imse(const ExperimentOptions& options) {
  const std::vector<const TechniqueInfo*> bases = chosen_bases(options, why_not_hemispherical);
  ExperimentResult result{Rows({"basis", "signal", "imse", "stderr"}), {}, {}};

  // Impulses, by quadrature: one sun at each elevation, and the expectation over all directions.
  std::vector<Impulses> suns;
  for (int degrees = 0; degrees <= 90; degrees += kElevationStep) suns.push_back(impulses_at_elevation(degrees));
  suns.push_back(uniform_impulses());
  options.progress("fitting");
  const Quadrature points = sphere_quadrature(0, kSignalRings);
  std::vector<HemisphereFit> fits;
  for (const TechniqueInfo* basis : bases) fits.emplace_back(*basis, points);
  std::vector<std::vector<double>> sun_errors(bases.size());
  parallel_for(bases.size(), [&](std::size_t b, int) {
    for (const Impulses& sun : suns) sun_errors[b].push_back(impulse_error(fits[b], sun));
  });

  std::vector<std::vector<Mean>> signals(3);
  for (const std::vector<double>& errors : sun_errors) signals[0].push_back({errors.back(), 0});
  options.progress("random impulses");
  signals[1] = random_errors(SignalKind::impulses, fits, points, options);
  options.progress("random harmonics");
  signals[2] = random_errors(SignalKind::harmonics, fits, points, options);

  LineChart sweep;
  sweep.title = "A single sun over its elevation";
  sweep.subtitle =
      "Unit impulse; mean over azimuths. S1 is the mean of these, weighted by the cosine of the elevation.";
  sweep.x.title = "elevation above the horizon, degrees";
  sweep.y.title = "IMSE, irradiance² sr";
  sweep.y.logarithmic = true;
  sweep.y.low = 1e-4;  // some hold a sun at the zenith exactly
  sweep.x.high = 90;
  for (std::size_t b = 0; b < bases.size(); ++b) {
    const std::string name(bases[b]->name);
    const std::vector<std::string> labels{"S1", "S2", "S3"};
    for (std::size_t s = 0; s < labels.size(); ++s)
      result.rows.add(
          {name, labels[s], signals[s][b].value, s == 0 ? Cell() : number_cell(signals[s][b].standard_error)});
    sweep.series.push_back({name, {}, {}, false});
    for (std::size_t k = 0; k + 1 < suns.size(); ++k) {
      const int degrees = int(k) * kElevationStep;
      result.rows.add({name, fmt::format("sun_{}", degrees), sun_errors[b][k], Cell()});
      sweep.series.back().x.push_back(degrees);
      sweep.series.back().y.push_back(sun_errors[b][k]);
    }
  }
  result.notes.push_back(
      "sun_E: one unit impulse E degrees above the horizon. S1 and suns by quadrature: no standard error.");
  if (options.samples == 1)
    result.notes.push_back("S2, S3: one signal has no standard error; --samples 2 or more gives one");
  if (options.pictures && !bases.empty()) {
    result.pictures.push_back({"basis-imse", error_chart(fits, signals, {"S1", "S2", "S3"})});
    result.pictures.push_back({"basis-imse-sun", draw(sweep)});
  }
  return result;
}

}  // namespace twinshade
