// Pictures in the manner of the papers' figures: functions of bases over the hemisphere (Habel and Wimmer, Efficient
// Irradiance Normal Mapping, I3D 2010, figure 2) and over the sphere (Iwanicki and Sloan, Ambient Dice, EGSR 2017,
// figures 6 and 7), irradiance signals and what each basis makes of them (EINM, figure 4). AD's figures 9 and 10 are
// pictures of probe-rmse.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/chart.h"
#include "experiments/hemisphere_fit.h"
#include "experiments/probe_light.h"
#include "experiments/tiles.h"

namespace twinshade {
namespace {

constexpr std::uint32_t kDisc = 96, kMapWidth = 144, kMapHeight = 72;  // pixels of an image
constexpr double kSunElevation = 40;                                   // the worst for H6

// Blue below zero, white at zero, red above; full at +-1.
Color signed_color(double value) {
  const double t = std::clamp(value, -1.0, 1.0), fade = 1 - std::abs(t);
  const auto mixed = [&](double full) { return static_cast<unsigned char>(full + (255 - full) * fade + 0.5); };
  return t < 0 ? Color{mixed(33), mixed(80), mixed(172)} : Color{mixed(178), mixed(24), mixed(43)};
}

// Points of an image: the upper hemisphere seen from above, or the whole sphere as a lat-long map.
struct Canvas {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::dvec3> directions;
  std::vector<std::size_t> pixels;  // of each direction

  PixelImage image(const std::vector<Color>& colors) const {
    PixelImage image{width, height, std::vector<unsigned char>(std::size_t(width) * height * 3, 255)};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      unsigned char* rgb = image.rgb.data() + pixels[i] * 3;
      rgb[0] = colors[i].r, rgb[1] = colors[i].g, rgb[2] = colors[i].b;
    }
    return image;
  }
};

// x to the right, y upwards, z towards the eye.
Canvas disc_canvas() {
  Canvas canvas{kDisc, kDisc, {}, {}};
  for (std::uint32_t row = 0; row < kDisc; ++row)
    for (std::uint32_t column = 0; column < kDisc; ++column) {
      const double x = (2 * column + 1.0) / kDisc - 1, y = 1 - (2 * row + 1.0) / kDisc, below = 1 - x * x - y * y;
      if (below <= 0) continue;
      canvas.directions.push_back({x, y, std::sqrt(below)});
      canvas.pixels.push_back(std::size_t(row) * kDisc + column);
    }
  return canvas;
}

Canvas map_canvas() {
  Canvas canvas{kMapWidth, kMapHeight, {}, {}};
  Environment grid;
  grid.width = kMapWidth;
  grid.height = kMapHeight;
  for (std::uint32_t y = 0; y < kMapHeight; ++y)
    for (std::uint32_t x = 0; x < kMapWidth; ++x) {
      canvas.directions.push_back(grid.pixel_direction(x, y));
      canvas.pixels.push_back(std::size_t(y) * kMapWidth + x);
    }
  return canvas;
}

// The first functions of a basis, all on one scale.
TileRow function_tiles(const TechniqueInfo& basis, const Canvas& canvas, int most) {
  const Matrix values = basis_matrix(basis, canvas.directions);
  const int count = std::min(basis.count, most);
  double largest = 0;
  for (Eigen::Index p = 0; p < values.rows(); ++p)
    for (int i = 0; i < count; ++i) largest = std::max(largest, std::abs(values(p, i)));
  TileRow row{fmt::format("{} ({})", basis.name, basis.count), {}};
  for (int i = 0; i < count; ++i) {
    std::vector<Color> colors;
    for (Eigen::Index p = 0; p < values.rows(); ++p)
      colors.push_back(signed_color(largest > 0 ? values(p, i) / largest : 0));
    row.tiles.push_back({canvas.image(colors), std::to_string(i)});
  }
  return row;
}

// Bases whose functions are drawn: those that differ from another's only by projection would be drawn twice.
bool has_own_functions(const TechniqueInfo& basis) {
  return basis.linear && (basis.projection == Projection::least_squares || basis.projection == Projection::truncation);
}

struct Signal {
  std::string label;
  SignalBlock samples, shown;  // over the quadrature and over the picture
  Impulses impulse = {};       // where the signal is a single one
};

std::vector<Signal> example_signals(std::uint64_t seed, const std::vector<glm::dvec3>& points,
                                    const std::vector<glm::dvec3>& pixels) {
  const TechniqueInfo& harmonics = find_technique("sh5");
  const Matrix at_points = basis_matrix(harmonics, points), at_pixels = basis_matrix(harmonics, pixels);
  std::vector<Signal> signals;
  signals.push_back({fmt::format("sun at {}°", kSunElevation), sun_signal(kSunElevation, points),
                     sun_signal(kSunElevation, pixels), sun_impulse(kSunElevation)});
  signals.push_back({"16 impulses", random_signals(SignalKind::impulses, seed, 0, 1, points, at_points),
                     random_signals(SignalKind::impulses, seed, 0, 1, pixels, at_pixels)});
  signals.push_back({"random SH", random_signals(SignalKind::harmonics, seed, 0, 1, points, at_points),
                     random_signals(SignalKind::harmonics, seed, 0, 1, pixels, at_pixels)});
  return signals;
}

double squared_error(const HemisphereFit& fit, const Matrix& coefficients, const Signal& signal,
                     const std::vector<double>& weights) {
  double error = 0;
  for (std::size_t p = 0; p < weights.size(); ++p) {
    double residual = -signal.samples.irradiance(Eigen::Index(p), 0);
    for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
      residual += coefficients(i, 0) * fit.functions()(Eigen::Index(p), i);
    error += weights[p] * residual * residual;
  }
  return error;
}

// Over the quadrature, and of a single impulse over the lune that it lights, as basis-imse has it.
ImpulseFit fit_signal(const HemisphereFit& fit, const Signal& signal, const std::vector<double>& weights) {
  if (signal.impulse.points_each > 0) return fit_impulses(fit, signal.impulse).front();
  const Matrix coefficients = fit.coefficients(signal.samples);
  return {coefficients.col(0), squared_error(fit, coefficients, signal, weights)};
}

Drawing signal_figure(const std::vector<const TechniqueInfo*>& bases, std::uint64_t seed, Rows& rows) {
  const Canvas canvas = disc_canvas();
  const Quadrature& points = domain_quadrature(Domain::hemisphere);
  const std::vector<Signal> signals = example_signals(seed, points.directions, canvas.directions);
  std::vector<double> largest;
  std::vector<TileRow> tiles{{"exact", {}}};
  const auto tile = [&](const std::vector<double>& values, double scale, std::string caption) {
    std::vector<Color> colors;
    for (const double value : values) colors.push_back(signed_color(value / scale));
    return Tile{canvas.image(colors), std::move(caption)};
  };
  for (const Signal& signal : signals) {
    std::vector<double> values;
    for (Eigen::Index p = 0; p < signal.shown.irradiance.rows(); ++p) values.push_back(signal.shown.irradiance(p, 0));
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    largest.push_back(most);
    tiles[0].tiles.push_back(tile(values, most, signal.label));
  }
  for (const TechniqueInfo* basis : bases) {
    const HemisphereFit fit(*basis, points);
    const Matrix functions = basis_matrix(*basis, canvas.directions);
    tiles.push_back({fmt::format("{} ({})", basis->name, basis->count), {}});
    for (std::size_t s = 0; s < signals.size(); ++s) {
      const auto [coefficients, error] = fit_signal(fit, signals[s], points.weights);
      std::vector<double> values(canvas.directions.size(), 0.0);
      for (std::size_t p = 0; p < values.size(); ++p)
        for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
          values[p] += coefficients(i) * functions(Eigen::Index(p), i);
      rows.add({std::string("figures-signals"), std::string(basis->name), signals[s].label, error});
      tiles.back().tiles.push_back(tile(values, largest[s], "ISE " + short_number(error)));
    }
  }
  return draw_tiles("Irradiance over the hemisphere and what bases make of it",
                    "Seen from above; red positive, blue negative. ISE: integral of the squared error.", tiles);
}

}  // namespace

ExperimentResult run_figures(const ExperimentOptions& options) {
  const std::vector<const TechniqueInfo*> linear = chosen_bases(
      options, [](const TechniqueInfo& basis) { return basis.linear ? "" : "it is not linear: it has no functions"; });
  ExperimentResult result{Rows({"figure", "basis", "signal", "ise"}), {}, {}};
  std::vector<TileRow> hemisphere, sphere;
  std::vector<const TechniqueInfo*> fitted;
  const Canvas disc = disc_canvas(), map = map_canvas();
  for (const TechniqueInfo* basis : linear) {
    options.progress(std::string(basis->name));
    if (why_not_hemispherical(*basis).empty()) fitted.push_back(basis);
    if (!options.pictures || !has_own_functions(*basis)) continue;
    if (basis->domain == Domain::hemisphere) hemisphere.push_back(function_tiles(*basis, disc, 9));
    if (basis->domain != Domain::hemisphere) sphere.push_back(function_tiles(*basis, map, 6));
  }
  Drawing signals = signal_figure(fitted, options.seed, result.rows);
  result.notes.push_back("what bases make of a probe (AD figures 9 and 10): experiment probe-rmse -o DIR");
  if (!options.pictures) return result;
  const std::string colors =
      "Red positive, blue negative, each basis on a scale of its own. In brackets: how many functions.";
  if (!hemisphere.empty())
    result.pictures.push_back(
        {"figures-hemisphere-functions",
         draw_tiles("Functions of bases of the hemisphere, seen from above", colors, hemisphere)});
  if (!sphere.empty())
    result.pictures.push_back(
        {"figures-sphere-functions",
         draw_tiles("Functions of bases of the sphere, lat-long, the first six of each", colors, sphere)});
  if (!fitted.empty()) result.pictures.push_back({"figures-signals", std::move(signals)});
  return result;
}

}  // namespace twinshade
