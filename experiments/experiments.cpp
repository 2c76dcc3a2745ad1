#include "base/error.h"
#include "base/names.h"
#include "experiments/experiment.h"
#include "experiments/probe_light.h"

namespace twinshade {
namespace {

using Names = std::vector<std::string>;

Names imse_pictures(const ExperimentOptions&) { return {"basis-imse", "basis-imse-sun"}; }

Names figures_pictures(const ExperimentOptions&) {
  return {"figures-hemisphere-functions", "figures-sphere-functions", "figures-signals"};
}

Names frobenius_pictures(const ExperimentOptions&) { return {"frobenius"}; }

Names sphere_map_pictures(const ExperimentOptions&) {
  Names names;
  for (int order = 1; order <= 6; ++order) names.push_back("sphere-map-mse-order-" + std::to_string(order));
  return names;
}

Names probe_pictures(const ExperimentOptions& options) {
  Names names{"probe-rmse"};
  for (const std::string& probe : probe_names(options))
    for (const char* what : {"", "-irradiance"}) names.push_back("probe-rmse-" + probe + what);
  return names;
}

Names visibility_pictures(const ExperimentOptions&) {
  Names names;
  for (const char* figure : {"components", "components-visibility", "components-light", "components-turned", "orders",
                             "normal-map", "environments"})
    names.push_back(std::string("visibility-figures-") + figure);
  return names;
}

Names wobble_pictures(const ExperimentOptions&) { return {"wobble", "wobble-profile"}; }

constexpr ExperimentInfo kExperiments[] = {
    {"basis-imse",
     "error of hemispherical bases on impulses and random signals",
     false,
     {"--basis", "--samples"},
     imse_pictures,
     run_basis_imse},
    {"figures",
     "pictures of basis functions, and of signals through hemispherical bases",
     false,
     {"--basis"},
     figures_pictures,
     run_figures},
    {"frobenius",
     "how much of the spherical harmonics each basis holds, and the condition of its Gram matrix",
     false,
     {"--basis"},
     frobenius_pictures,
     run_frobenius},
    {"sphere-map-mse",
     "error of sphere maps that store spherical harmonics, against their size",
     false,
     {"--map", "--map-width", "--order", "--on", "--driver-filters", "--samples"},
     sphere_map_pictures,
     run_sphere_map_mse},
    {"probe-rmse",
     "error of irradiance probes through bases of the sphere",
     true,
     {"--basis", "--relative", "--clamp-radiance"},
     probe_pictures,
     run_probe_rmse},
    {"visibility-figures",
     "pictures and errors of precomputed visibility on the scene house",
     true,
     {"--samples", "--clamp-radiance"},
     visibility_pictures,
     run_visibility_figures},
    {"wobble",
     "a single light steered over the sphere: how its peak, rings and shape change",
     false,
     {"--basis", "--samples"},
     wobble_pictures,
     run_wobble},
};

}  // namespace

std::span<const ExperimentInfo> experiments() { return kExperiments; }

const ExperimentInfo& find_experiment(std::string_view name) {
  std::vector<std::string> names;
  for (const ExperimentInfo& experiment : kExperiments) {
    if (experiment.name == name) return experiment;
    names.emplace_back(experiment.name);
  }
  throw UserError(unknown_name_message("experiment", name, names));
}

}  // namespace twinshade
