#include "experiments/probe_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/portable_math.h"
#include "experiments/chart.h"
#include "golden/pictures.h"
#include "lighting/environment_light.h"
#include "lighting/projection.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

constexpr int kFewestCellPoints = 4;                               // of icosahedral_quadrature: 3,840 normals
constexpr std::uint32_t kPictureWidth = 128, kPictureHeight = 64;  // of pictures
// Pixels count as lights from their centres. Pictures of fewer rows are refined: what that leaves of the light's error
// is a few 1e-6 of it.
constexpr std::uint32_t kFewRows = 128;
constexpr std::size_t kMostProducts = 1600000000;  // of pixels and normals: some seconds

std::vector<double> over_pi(std::vector<double> values) {
  for (double& value : values) value /= portable::kPi;
  return values;
}

std::vector<std::string> chosen_probes(const ExperimentOptions& options) {
  return options.probes.empty() ? environment_names() : options.probes;
}

}  // namespace

std::vector<std::string> probe_names(const ExperimentOptions& options) {
  std::vector<std::string> names;
  for (const std::string& path : chosen_probes(options)) {
    const std::string stem = std::filesystem::path(path).stem().string();
    std::string name = stem;
    for (int number = 2; std::count(names.begin(), names.end(), name) > 0; ++number)
      name = fmt::format("{}-{}", stem, number);
    names.push_back(name);
  }
  return names;
}

std::vector<Probe> load_probes(const ExperimentOptions& options) {
  const std::vector<std::string> names = probe_names(options), paths = chosen_probes(options);
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < paths.size(); ++i)
    probes.push_back(
        {names[i], refine_small_environment(load_environment(paths[i], options.clamp_radiance), kFewRows)});
  return probes;
}

ProbeLight measured_light(const Probe& probe, int cell_points) {
  const std::size_t pixels = std::size_t(probe.environment.width) * probe.environment.height;
  while (cell_points > kFewestCellPoints && pixels * std::size_t(240 * cell_points * cell_points) > kMostProducts)
    --cell_points;
  const Quadrature points = icosahedral_quadrature(cell_points);
  ProbeLight light;
  light.name = probe.name;
  light.normals = points.directions;
  light.weights = points.weights;
  light.irradiance = over_pi(environment_irradiance(probe.environment, light.normals));
  light.radiance = over_pi(environment_radiance(probe.environment, 5));
  light.radiance.resize(std::size_t(kMostRadianceCount) * 3, 0.0);  // l = 5 has no irradiance
  return light;
}

ProbeLight drawn_light(const Probe& probe) {
  ProbeLight light;
  light.name = probe.name;
  light.width = kPictureWidth;
  light.height = kPictureHeight;
  Environment grid;  // where a lat-long picture of this size has its pixels
  grid.width = kPictureWidth;
  grid.height = kPictureHeight;
  for (std::uint32_t y = 0; y < kPictureHeight; ++y)
    for (std::uint32_t x = 0; x < kPictureWidth; ++x) light.normals.push_back(grid.pixel_direction(x, y));
  light.irradiance = over_pi(environment_irradiance(probe.environment, light.normals));
  return light;
}

std::vector<double> fitted_coefficients(const TechniqueInfo& basis, const ProbeLight& light) {
  return SampleProjector(basis, light.normals, light.weights).project(light.irradiance, light.radiance);
}

ProbeError probe_error(const ProbeLight& light, const std::vector<double>& reconstruction) {
  ProbeError error;
  for (std::size_t c = 0; c < 3; ++c) {
    double area = 0, squares = 0, energy = 0;
    for (std::size_t p = 0; p < light.weights.size(); ++p) {
      const double exact = light.irradiance[p * 3 + c], difference = reconstruction[p * 3 + c] - exact;
      area += light.weights[p];
      squares += light.weights[p] * difference * difference;
      energy += light.weights[p] * exact * exact;
    }
    error.rmse += std::sqrt(squares / area) / 3;
    error.relative += energy > 0 ? std::sqrt(squares / energy) / 3 : std::numeric_limits<double>::quiet_NaN();
  }
  return error;
}

std::string why_not_spherical(const TechniqueInfo& basis) {
  return basis.domain == Domain::hemisphere ? "it is of the hemisphere, not of the sphere" : "";
}

RadiometricImage radiometric_image(const ProbeLight& light, const std::vector<double>& values) {
  RadiometricImage image{light.width, light.height, {}};
  for (const double value : values) image.rgb.push_back(float(value));
  return image;
}

PixelImage display_image(const ProbeLight& light, const std::vector<double>& values, double scale) {
  PixelImage image{light.width, light.height, {}};
  for (const double value : values) image.rgb.push_back(display_value(value * scale, 0, Tonemap::reinhard));
  return image;
}

PixelImage error_image(const ProbeLight& light, const std::vector<double>& reconstruction, double largest) {
  PixelImage image{light.width, light.height, {}};
  for (std::size_t p = 0; p < light.normals.size(); ++p) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(reconstruction[p * 3 + c] - light.irradiance[p * 3 + c]);
    const Color color = heat_color(largest > 0 ? sum / 3 / largest : 0);
    image.rgb.insert(image.rgb.end(), {color.r, color.g, color.b});
  }
  return image;
}

double display_scale(const ProbeLight& light) {
  double sum = 0;
  for (const double value : light.irradiance) sum += value;
  return sum > 0 ? double(light.irradiance.size()) / sum : 1;
}

}  // namespace twinshade
