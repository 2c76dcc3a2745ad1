#include "experiments/stability/light_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

constexpr int kHemisphereRings = 64, kCellPoints = 8;  // of the quadrature that fits: a sun's ring to 1e-4 of its peak

// Where the quadrature does not blur the kink at a sun's horizon: the coefficients are those of its radiance.
bool made_from_radiance(Projection projection) {
  switch (projection) {
    case Projection::truncation:
    case Projection::window_hanning:
    case Projection::window_lanczos:
    case Projection::window_minimum:
    case Projection::through_sh3:
    case Projection::irradiance_sh2:
    case Projection::zonal:
      return true;
    default:
      return false;
  }
}

}  // namespace

glm::dvec3 SmallLight::irradiance(const glm::dvec3& n) const {
  glm::dvec3 sum = constant;
  for (const Sun& sun : suns) sum += sun.strength * std::max(0.0, glm::dot(n, sun.direction));
  return sum;
}

std::vector<double> SmallLight::radiance() const {
  std::vector<double> sh(std::size_t(kMostRadianceCount) * 3, 0.0);
  for (int c = 0; c < 3; ++c) sh[std::size_t(c)] = constant[c] * 2 / std::sqrt(portable::kPi);  // sqrt(4pi) / pi
  for (const Sun& sun : suns) {
    const std::vector<double> values = radiance_basis({&sun.direction, 1}, kMostRadianceCount);
    for (std::size_t j = 0; j < values.size(); ++j)
      for (int c = 0; c < 3; ++c) sh[j * 3 + std::size_t(c)] += sun.strength[c] * values[j];
  }
  return sh;
}

SmallLight unit_sun(const glm::dvec3& direction) {
  return {fmt::format("sun ({:.3f}, {:.3f}, {:.3f})", direction.x, direction.y, direction.z), {}, {{direction}}};
}

void LightFit::prepare() const {
  if (radiance_ || samples_) return;
  if (made_from_radiance(basis_.projection)) {
    radiance_.emplace(basis_, kMostRadianceCount);
  } else if (basis_.projection != Projection::value_at_normal) {
    points_ = basis_.domain == Domain::hemisphere ? hemisphere_quadrature(kHemisphereRings)
                                                  : icosahedral_quadrature(kCellPoints);
    samples_.emplace(basis_, points_.directions, points_.weights);
  }
}

std::vector<double> LightFit::coefficients(const SmallLight& light) const {
  prepare();
  std::vector<double> found(std::size_t(basis_.count) * 3);
  if (radiance_) {
    radiance_->project(light.radiance().data(), found.data());
  } else if (samples_) {
    std::vector<double> irradiance;
    irradiance.reserve(points_.directions.size() * 3);
    for (const glm::dvec3& n : points_.directions) {
      const glm::dvec3 value = light.irradiance(n);
      irradiance.insert(irradiance.end(), {value.x, value.y, value.z});
    }
    found = samples_->project(irradiance, light.radiance());
  } else {
    const glm::dvec3 flat = light.irradiance({0, 0, 1});
    for (int c = 0; c < 3; ++c) found[std::size_t(c)] = flat[c];
  }
  for (double& value : found) value = double(float(value));
  return found;
}

}  // namespace twinshade
