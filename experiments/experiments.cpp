#include "base/error.h"
#include "base/names.h"
#include "experiments/experiment.h"

namespace twinshade {
namespace {

constexpr ExperimentInfo kExperiments[] = {
    {"basis-imse", "error of hemispherical bases on impulses and random signals", false, run_basis_imse},
    {"figures", "pictures of basis functions, and of signals through hemispherical bases", false, run_figures},
    {"frobenius", "how much of the spherical harmonics each basis holds, and the condition of its Gram matrix", false,
     run_frobenius},
    {"sphere-map-mse", "error of sphere maps that store spherical harmonics, against their size", false,
     run_sphere_map_mse},
    {"probe-rmse", "error of irradiance probes through bases of the sphere", true, run_probe_rmse},
    {"visibility-figures", "pictures and errors of precomputed visibility on the scene house", true,
     run_visibility_figures},
    {"wobble", "a single light steered over the sphere: how its peak, rings and shape change", false, run_wobble},
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
