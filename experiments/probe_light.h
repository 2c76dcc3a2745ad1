// Irradiance of an environment as a picture of the sphere, exactly and through each basis.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "lighting/registry.h"
#include "scenes/environment.h"

namespace twinshade {

// E / pi of an environment at some normals: exact, the sum over all its pixels, and no noise.
struct ProbeLight {
  std::string name;  // of the probe
  std::vector<glm::dvec3> normals;
  std::vector<double> irradiance;  // [normal * 3 + channel]

  // Where errors are measured: a quadrature in cells within which piecewise bases are smooth.
  std::vector<double> weights;   // solid angles
  std::vector<double> radiance;  // over pi: its real SH, 36 of which l <= 4 are set, [j * 3 + channel]

  // Where it is drawn: at the pixels of a lat-long picture (environment.h's orientation), without weights and radiance.
  std::uint32_t width = 0, height = 0;
};

// The probes asked for, or the built-in environments, small pictures refined: each pixel as several of its radiance, so
// that one light is the same however small it was stored. UserError as load_environment.
struct Probe {
  std::string name;  // of its file, without folder and ending; with a number behind it where another has that name
  Environment environment;
};
// Their names alone: no file is read.
std::vector<std::string> probe_names(const ExperimentOptions& options);
std::vector<Probe> load_probes(const ExperimentOptions& options);

// 240 cells of cell_points^2 normals, fewer where the environment has so many pixels that the product would take
// minutes. 14: relative errors of RMSE up to 1e-5.
ProbeLight measured_light(const Probe& probe, int cell_points = 14);
ProbeLight drawn_light(const Probe& probe);

// Coefficients fitted to the samples of a measured light, or made from radiance, as the basis wants: [i * 3 + channel].
std::vector<double> fitted_coefficients(const TechniqueInfo& basis, const ProbeLight& light);

struct ProbeError {
  double rmse = 0;      // root of the mean square over the sphere, mean of the three channels
  double relative = 0;  // over the root mean square of the light itself; NaN where a channel has none
};
// reconstruction: at the normals of a measured light.
ProbeError probe_error(const ProbeLight& light, const std::vector<double>& reconstruction);

// The bases that can hold light from everywhere; `why_not` for chosen_bases.
std::string why_not_spherical(const TechniqueInfo& basis);

// Of drawn lights.
RadiometricImage radiometric_image(const ProbeLight& light, const std::vector<double>& values);
// For the eye: `scale` times the value through the tone curve x / (1 + x) and sRGB.
PixelImage display_image(const ProbeLight& light, const std::vector<double>& values, double scale);
// |reconstruction - light|, mean of the channels, from black at 0 to yellow at `largest`.
PixelImage error_image(const ProbeLight& light, const std::vector<double>& reconstruction, double largest);
// 1 over the mean of the light, so that pictures of any probe are neither dark nor bright; 1 where it has none.
double display_scale(const ProbeLight& light);

}  // namespace twinshade
