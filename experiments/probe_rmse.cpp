// How far irradiance through a basis is from the exact one of an environment (Iwanicki and Sloan, Ambient Dice, EGSR
// 2017, figure 8): E / pi, root mean square over the sphere by solid angle, mean of the three channels. The pictures
// are those of figures 9 and 10: what each basis makes of the probe, and where it is wrong.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "experiments/bases.h"
#include "experiments/chart.h"
#include "experiments/chart_parts.h"
#include "experiments/probe_light.h"
#include "lighting/projection.h"

namespace twinshade {
namespace {

constexpr double kTileWidth = 208, kTileHeight = 104, kGap = 16, kTop = 76, kCaption = 34;
constexpr int kTilesAcross = 4;

// The reference first, then each basis: its picture, and below it its error, all errors on one scale.
Drawing comparison(const ProbeLight& light, const std::vector<const TechniqueInfo*>& bases,
                   const std::vector<std::vector<double>>& reconstructions, const std::vector<double>& errors) {
  const double scale = display_scale(light);
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  // Not below what sums over pixels are good for: of light that all bases hold, that alone would be left to see
  const double finest = 1e-4 / scale;
  const double largest = sorted.empty() ? 0 : std::max(3 * sorted[sorted.size() / 2], finest);
  const int rows = int(bases.size() + 1 + kTilesAcross - 1) / kTilesAcross;
  const double cell_width = kTileWidth + kGap, cell_height = 2 * kTileHeight + 4 + kCaption;
  const std::string title = "Irradiance of the probe " + light.name + ", exact and through each basis";
  Drawing drawing(std::max(kGap + kTilesAcross * cell_width, 32 + text_width(title, 19.5)), kTop + rows * cell_height);
  drawing.text({16, 28}, title, {.size = 17, .color = kInk, .bold = true});
  drawing.text({16, 48},
               fmt::format("Lat-long, up is up, E / pi, tone mapped. Below each: absolute error, dark blue 0 to yellow "
                           "{} and more. In brackets: RMSE.",
                           short_number(largest)),
               {.size = 12, .color = kFaint});
  for (std::size_t tile = 0; tile <= bases.size(); ++tile) {
    const double x = kGap + double(tile % kTilesAcross) * cell_width;
    const double y = kTop + double(tile / kTilesAcross) * cell_height;
    const std::vector<double>& values = tile == 0 ? light.irradiance : reconstructions[tile - 1];
    drawing.image({x, y}, kTileWidth, kTileHeight, display_image(light, values, scale));
    if (tile > 0) drawing.image({x, y + kTileHeight + 4}, kTileWidth, kTileHeight, error_image(light, values, largest));
    const std::string caption =
        tile == 0 ? "exact" : fmt::format("{} ({})", bases[tile - 1]->name, short_number(errors[tile - 1]));
    drawing.text({x, y + (tile == 0 ? 1 : 2) * kTileHeight + 20}, caption, {.size = 12, .color = kInk});
  }
  return drawing;
}

Drawing error_chart(const std::vector<const TechniqueInfo*>& bases, const std::vector<Probe>& lights,
                    const std::vector<std::vector<double>>& errors) {
  BarChart chart;
  chart.title = lights.size() == 1 ? "Error of the irradiance probe " + lights[0].name : "Error of irradiance probes";
  chart.subtitle =
      "Root mean square over the sphere of E / pi, mean of the three channels; reference: the sum over all pixels. In "
      "brackets: coefficients.";
  chart.value.title = "RMSE of E / pi, in the probe's unit of radiance";
  chart.value.logarithmic = true;
  chart.value.most_decades = 5;  // what is exact but for rounding would squeeze everything else into a corner
  std::vector<std::size_t> order(bases.size());
  for (std::size_t b = 0; b < order.size(); ++b) order[b] = b;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return errors[0][a] > errors[0][b]; });
  for (const std::size_t b : order) chart.rows.push_back(fmt::format("{} ({})", bases[b]->name, bases[b]->count));
  for (std::size_t l = 0; l < lights.size(); ++l) {
    chart.bars.push_back({lights[l].name, {}});
    for (const std::size_t b : order) chart.bars.back().values.push_back(errors[l][b]);
  }
  return draw(chart);
}

}  // namespace

ExperimentResult run_probe_rmse(const ExperimentOptions& options) {
  const std::vector<const TechniqueInfo*> bases = chosen_bases(options, why_not_spherical);
  const std::vector<Probe> probes = load_probes(options);
  std::vector<std::string> columns{"basis", "probe", "rmse"};
  if (options.relative) columns.push_back("relative");
  ExperimentResult result{Rows(columns), {}, {}};

  std::vector<std::vector<double>> errors;
  for (const Probe& probe : probes) {
    options.progress(probe.name + ": exact irradiance");
    if (!probe.environment.note.empty()) result.notes.push_back(probe.environment.note);
    const ProbeLight light = measured_light(probe), drawn = options.pictures ? drawn_light(probe) : ProbeLight();
    options.progress(probe.name + ": bases");
    std::vector<std::vector<double>> pictures(bases.size());
    std::vector<ProbeError> found(bases.size());
    parallel_for(bases.size(), [&](std::size_t b, int) {
      const std::vector<double> coefficients = fitted_coefficients(*bases[b], light);
      found[b] = probe_error(light, reconstruct(*bases[b], coefficients, light.normals));
      if (options.pictures) pictures[b] = reconstruct(*bases[b], coefficients, drawn.normals);
    });
    errors.emplace_back();
    bool dark = false;
    for (std::size_t b = 0; b < bases.size(); ++b) {
      errors.back().push_back(found[b].rmse);
      std::vector<Cell> row{std::string(bases[b]->name), light.name, number_cell(found[b].rmse)};
      if (options.relative) row.push_back(number_cell(found[b].relative));
      result.rows.add(std::move(row));
      dark = dark || std::isnan(found[b].relative);
    }
    if (options.relative && dark)
      result.notes.push_back("probe " + light.name +
                             ": a channel has no light, so errors relative to it are not defined");
    if (!options.pictures) continue;
    result.pictures.push_back({"probe-rmse-" + light.name, comparison(drawn, bases, pictures, errors.back())});
    result.pictures.push_back({"probe-rmse-" + light.name + "-irradiance", radiometric_image(drawn, drawn.irradiance)});
  }
  if (options.pictures && !bases.empty() && !probes.empty())
    result.pictures.push_back({"probe-rmse", error_chart(bases, probes, errors)});
  return result;
}

}  // namespace twinshade
