// Precomputed visibility on the scene house, in the manner of figures 4 to 7 of Iwanicki and Sloan, Normal Mapping with
// Low-Frequency Precomputed Visibility (NMV), JGT 2012: components against all coefficients, orders against
// rays, normal maps on and off, other environments. Every frame is drawn on the CPU by the techniques' own shaders; the
// rows have the errors that the pictures show.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/portable_math.h"
#include "experiments/probe_light.h"
#include "experiments/reference_frame.h"
#include "experiments/tiles.h"
#include "golden/pictures.h"
#include "lighting/environment_light.h"
#include "lighting/radiance_basis.h"
#include "lighting/visibility_bundle.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

constexpr std::uint32_t kWidth = 640, kHeight = 400, kLightmap = 256;
constexpr double kTileScale = 0.5;   // of a drawing's pixel; PNG files have twice as many
constexpr double kMiddleGrey = 0.4;  // what the mean radiance is shown at, before the tone curve
constexpr int kDefaultRays = 512, kReferenceRays = 256;
constexpr int kOrders[] = {4, 6};
constexpr double kTurn = 90;  // degrees about the vertical
constexpr const char* kComponents[] = {"pca4", "pca8", "pca12", "pca16", "pca24"};

std::vector<const TechniqueInfo*> named(std::initializer_list<const char*> names) {
  std::vector<const TechniqueInfo*> list;
  for (const char* name : names) list.push_back(&find_technique(name));
  return list;
}

// Frames of the scene under one environment.
class Shot {
 public:
  Shot(const Scene& scene, const VisibilityBake& visibility, const Probe& probe, const ExperimentOptions& options)
      : scene_(scene),
        visibility_(visibility),
        probe_(probe),
        options_(options),
        radiance_(environment_radiance(probe.environment, kHighestOrder)),
        turned_radiance_(environment_radiance(rotate_environment(probe.environment, kTurn), kHighestOrder)) {}

  const std::string& environment() const { return probe_.name; }

  // What components are chosen for: what surfaces show of any light, visibility all around (as the paper has
  // them), this light, or this one before it was turned by kTurn.
  enum class Components { any_light, all_around, this_light, turned_light };

  // order: of the visibility behind components.
  std::vector<Frame> draw(const std::vector<const TechniqueInfo*>& techniques, int order, bool normal_map = true,
                          Components components = Components::any_light) const {
    std::vector<LitTechnique> wanted;
    for (const TechniqueInfo* technique : techniques) wanted.push_back({technique, CoefficientStorage::lightmap});
    std::vector<LightBake> lights;
    if (std::any_of(techniques.begin(), techniques.end(),
                    [](const TechniqueInfo* t) { return t->weights == VisibilityWeights::none; })) {
      BakeOptions bake;
      bake.lightmap_size = kLightmap, bake.seed = options_.seed, bake.show_progress = false;
      lights.push_back(bake_light(scene_, probe_.environment, bake));
    }
    Bundle bundle = make_bundle(scene_, lights, wanted, frame(normal_map));
    VisibilityLighting lighting;
    lighting.maps = {&sphere_maps().front()};
    lighting.order = order;
    lighting.metric = components == Components::any_light    ? PcaMetric::surface
                      : components == Components::all_around ? PcaMetric::visibility
                                                             : PcaMetric::irradiance;
    if (components == Components::turned_light) lighting.metric_light = turned_radiance_;
    add_visibility(bundle, scene_, {&visibility_, 1}, radiance_, wanted, lighting);
    std::vector<Frame> frames;
    for (const TechniqueInfo* technique : techniques) {
      options_.progress(fmt::format("{} under {}", technique->name, probe_.name));
      frames.push_back(options_.draw("cpu", bundle, technique_source(*technique, CoefficientStorage::lightmap)));
    }
    return frames;
  }

  // By rays, under what l <= 5 leave of the environment: what the techniques light with.
  Frame traced() const {
    options_.progress("rays under " + probe_.name);
    ReferenceOptions trace;
    trace.rays = kReferenceRays, trace.seed = options_.seed, trace.show_progress = false;
    return draw_reference(scene_, environment_of_radiance(radiance_, kHighestOrder, 512), frame(true), trace,
                          options_.draw)
        .frame;
  }

 private:
  FrameOptions frame(bool normal_map) const {
    FrameOptions frame;
    frame.width = kWidth, frame.height = kHeight;
    frame.camera = scene_.camera;
    frame.normal_map = normal_map;
    return frame;
  }

  const Scene& scene_;
  const VisibilityBake& visibility_;
  const Probe& probe_;
  const ExperimentOptions& options_;
  const std::vector<double> radiance_, turned_radiance_;
};

double mean_radiance(const Frame& frame) {
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < frame.coverage.size(); ++p)
    for (std::size_t c = 0; c < 3 && frame.coverage[p]; ++c) sum += frame.color[p * 4 + c], count += 1;
  return count > 0 ? sum / count : 0;
}

// Root mean square over covered pixels and channels.
double rmse(const Frame& frame, const Frame& exact) {
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < frame.coverage.size(); ++p)
    for (std::size_t c = 0; c < 3 && frame.coverage[p]; ++c) {
      const double error = double(frame.color[p * 4 + c]) - double(exact.color[p * 4 + c]);
      sum += error * error, count += 1;
    }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

// Frames as images, all with one exposure.
class Display {
 public:
  explicit Display(const Frame& exposed_by) {
    const double mean = mean_radiance(exposed_by);
    if (mean > 0) exposure_ = portable::log2(kMiddleGrey / mean);
  }

  PixelImage image(const Frame& frame) const {
    return image_of(frame, [&](std::size_t i) { return shown(frame, i); });
  }
  // Of the shown values, four times as large.
  PixelImage difference(const Frame& a, const Frame& b) const {
    return image_of(a, [&](std::size_t i) { return std::min(4 * std::abs(shown(a, i) - shown(b, i)), 255); });
  }

 private:
  int shown(const Frame& frame, std::size_t i) const {
    return display_value(double(frame.color[i]), exposure_, Tonemap::reinhard);
  }

  template <class Value>
  static PixelImage image_of(const Frame& frame, const Value& value) {
    PixelImage image{frame.width, frame.height, std::vector<unsigned char>(frame.coverage.size() * 3)};
    for (std::size_t y = 0; y < frame.height; ++y)  // frames are y-up
      for (std::size_t x = 0; x < frame.width; ++x) {
        const std::size_t from = (frame.height - 1 - y) * frame.width + x, to = y * frame.width + x;
        for (std::size_t c = 0; c < 3; ++c) image.rgb[to * 3 + c] = static_cast<unsigned char>(value(from * 4 + c));
      }
    return image;
  }

  double exposure_ = 0;
};

std::string percent_of_mean(double relative) {
  return std::isnan(relative) ? "0" : fmt::format("{:.2f}% of the mean", relative * 100);
}

// A row's last columns. The peak of psnr is what shows as white: the mean is at kMiddleGrey of it.
std::array<Cell, 3> error_cells(double error, double mean) {
  constexpr double kDecibels = 6.0205999132796239;  // 20 log10(2)
  const double relative = mean > 0 ? error / mean : std::nan("");
  const double psnr = relative > 0 ? -kDecibels * portable::log2(kMiddleGrey * relative) : std::nan("");
  return {error, number_cell(relative), number_cell(psnr)};
}

// One picture: a frame that counts as exact, others, and their differences below.
class Comparison4x {
 public:
  Comparison4x(ExperimentResult& result, std::string figure, const Shot& shot, int order, std::string against,
               const Frame& exact)
      : result_(result),
        figure_(std::move(figure)),
        shot_(shot),
        order_(order),
        against_(std::move(against)),
        exact_(exact),
        display_(exact) {}

  void add(const std::string& technique, const Frame& frame) {
    const double error = rmse(frame, exact_), mean = mean_radiance(exact_);
    const auto [absolute, relative, psnr] = error_cells(error, mean);
    result_.rows.add(
        {figure_, shot_.environment(), std::int64_t(order_), technique, against_, absolute, relative, psnr});
    frames_.tiles.push_back({display_.image(frame), technique});
    differences_.tiles.push_back({display_.difference(frame, exact_), "RMSE " + percent_of_mean(error / mean)});
  }

  // The frames, then four times their differences.
  void tile_rows(std::vector<TileRow>& rows, const std::string& label) {
    frames_.label = label;
    differences_.label = "4 x difference";
    frames_.tiles.insert(frames_.tiles.begin(), {display_.image(exact_), against_});
    differences_.tiles.insert(differences_.tiles.begin(), {display_.difference(exact_, exact_), "to this"});
    rows.push_back(std::move(frames_));
    rows.push_back(std::move(differences_));
  }

 private:
  ExperimentResult& result_;
  const std::string figure_;
  const Shot& shot_;
  const int order_;
  const std::string against_;
  const Frame& exact_;
  const Display display_;
  TileRow frames_, differences_;
};

void add_picture(ExperimentResult& result, const ExperimentOptions& options, const std::string& figure,
                 const std::string& title, const std::string& subtitle, const std::vector<TileRow>& rows) {
  if (options.pictures)
    result.pictures.push_back({"visibility-figures-" + figure, draw_tiles(title, subtitle, rows, kTileScale)});
}

void components_figure(ExperimentResult& result, const ExperimentOptions& options, const Shot& shot,
                       Shot::Components components, const std::string& figure, const std::string& title) {
  std::vector<TileRow> rows;
  for (const int order : kOrders) {
    const std::string all = order == 4 ? "unc4" : "unc6";
    std::vector<const TechniqueInfo*> techniques{&find_technique(all)};
    for (const char* name : kComponents) techniques.push_back(&find_technique(name));
    const std::vector<Frame> frames = shot.draw(techniques, order, true, components);
    Comparison4x comparison(result, figure, shot, order, all, frames[0]);
    for (std::size_t i = 1; i < frames.size(); ++i) comparison.add(std::string(techniques[i]->name), frames[i]);
    comparison.tile_rows(rows, fmt::format("order {}", order));
  }
  add_picture(result, options, figure, title,
              "4, 8, 12, 16 and 24 components of visibility of order 4 (16 coefficients) and 6 (36)", rows);
}

void orders_figure(ExperimentResult& result, const ExperimentOptions& options, const Shot& shot) {
  const std::vector<const TechniqueInfo*> techniques = named({"unc3", "unc4", "unc6", "preconv", "sh2_product"});
  const std::vector<Frame> frames = shot.draw(techniques, kHighestOrder);
  const Frame traced = shot.traced();
  Comparison4x comparison(result, "orders", shot, kHighestOrder, "reference", traced);
  for (std::size_t i = 0; i < frames.size(); ++i) comparison.add(std::string(techniques[i]->name), frames[i]);
  std::vector<TileRow> rows;
  comparison.tile_rows(rows, "order");
  add_picture(result, options, "orders", "Orders of visibility against rays",
              "reference: rays from each pixel, under what l <= 5 leave of the environment", rows);
}

void normal_map_figure(ExperimentResult& result, const ExperimentOptions& options, const Shot& shot) {
  const std::vector<const TechniqueInfo*> techniques = named({"unc6", "pca24", "pca_alu", "shlmap", "preconv"});
  const std::vector<Frame> on = shot.draw(techniques, kHighestOrder, true),
                           off = shot.draw(techniques, kHighestOrder, false);
  std::vector<TileRow> rows{{"normal map off", {}}, {"normal map on", {}}};
  const Display display(on[0]);
  for (std::size_t i = 0; i < techniques.size(); ++i) {
    const std::string name(techniques[i]->name);
    rows[0].tiles.push_back({display.image(off[i]), name});
    rows[1].tiles.push_back({display.image(on[i]), name});
    const double change = rmse(off[i], on[i]), mean = mean_radiance(on[i]);
    const auto [absolute, relative, psnr] = error_cells(change, mean);
    result.rows.add({std::string("normal-map"), shot.environment(), std::int64_t(kHighestOrder), name,
                     std::string("normal map off"), absolute, relative, psnr});
  }
  add_picture(result, options, "normal-map", "What normal maps add",
              "shlmap has bounced light as well; the others direct light alone", rows);
}

void environments_figure(ExperimentResult& result, const ExperimentOptions& options, const std::vector<Shot>& shots) {
  std::vector<TileRow> rows;
  for (const Shot& shot : shots) {
    const std::vector<const TechniqueInfo*> techniques = named({"unc6", "pca8", "pca24", "unc3"});
    const std::vector<Frame> frames = shot.draw(techniques, kHighestOrder);
    Comparison4x comparison(result, "environments", shot, kHighestOrder, "unc6", frames[0]);
    for (std::size_t i = 1; i < frames.size(); ++i) comparison.add(std::string(techniques[i]->name), frames[i]);
    comparison.tile_rows(rows, shot.environment());
  }
  add_picture(result, options, "environments", "Other environments on the same visibility",
              "Another environment costs tables, no rays", rows);
}

// The paper's claim as numbers, 12 components are enough at order 4, 16 to 24 at order 6: of those that serve any
// light, of the paper's own, and of those that are chosen for the light.
void note_enough_components(ExperimentResult& result) {
  const auto note = [&](const char* figure, int order, const char* technique, const char* what) {
    for (std::size_t r = 0; r < result.rows.size(); ++r)
      if (std::get<std::string>(result.rows.at(r, "figure")) == figure && result.rows.number(r, "order") == order &&
          std::get<std::string>(result.rows.at(r, "technique")) == technique)
        result.notes.push_back(
            fmt::format(fmt::runtime(what), order, technique, percent_of_mean(result.rows.number(r, "relative"))));
  };
  for (const auto& [order, technique] : {std::pair(4, "pca12"), {6, "pca16"}, {6, "pca24"}}) {
    note("components", order, technique, "order {}: {} is {} off all coefficients (as many as NMV calls enough)");
    note("components-visibility", order, technique, "order {}: {} chosen as the paper does is {} off all coefficients");
    note("components-light", order, technique, "order {}: {} chosen for the light is {} off all coefficients");
  }
}

}  // namespace

ExperimentResult run_visibility_figures(const ExperimentOptions& options) {
  if (!options.bases.empty() || !options.maps.empty())
    throw UserError("visibility-figures draws the published techniques: it takes no names of bases or sphere maps");
  const Scene scene = load_scene("house");
  const std::vector<Probe> probes = load_probes(options);
  VisibilityOptions bake;
  bake.lightmap_size = kLightmap;
  bake.rays = std::uint32_t(std::clamp(options.samples > 0 ? options.samples : kDefaultRays, 1, 65536));
  bake.seed = options.seed;
  bake.show_progress = false;
  options.progress("baking visibility");
  const VisibilityBake visibility = bake_visibility(scene, bake);
  std::vector<Shot> shots;
  for (const Probe& probe : probes) shots.emplace_back(scene, visibility, probe, options);

  ExperimentResult result{
      Rows({"figure", "environment", "order", "technique", "against", "rmse", "relative", "psnr"}), {}, {}};
  using Components = Shot::Components;
  components_figure(result, options, shots.front(), Components::any_light, "components",
                    "Components that keep what surfaces show of any light");
  components_figure(result, options, shots.front(), Components::all_around, "components-visibility",
                    "The paper's components, which keep visibility all around");
  components_figure(result, options, shots.front(), Components::this_light, "components-light",
                    "Components that keep irradiance under this light");
  components_figure(result, options, shots.front(), Components::turned_light, "components-turned",
                    "Components that keep irradiance under this light turned by 90 degrees");
  orders_figure(result, options, shots.front());
  normal_map_figure(result, options, shots.front());
  environments_figure(result, options, shots);
  note_enough_components(result);
  result.notes.push_back(
      "rmse: of radiance, over covered pixels and channels; relative: over the mean radiance of what it is held to; "
      "psnr: "
      "decibels, as the pictures are exposed, with the mean at 0.4 of the peak");
  return result;
}

}  // namespace twinshade
