#include <cmath>
#include <string>

#include "base/error.h"
#include "lighting/fit.h"
#include "lighting/projection.h"
#include "lighting/radiance_basis.h"
#include "lighting/windows.h"

namespace twinshade {

class SampleProjector::Rule {
 public:
  Rule(const TechniqueInfo& technique, std::span<const glm::dvec3> directions, std::span<const double> weights)
      : basis(technique), samples(directions.size()) {
    if (!basis.is_basis)
      throw UserError("technique " + std::string(basis.name) + " is not a basis: nothing to project on");
    check(directions, weights);
    switch (basis.projection) {
      case Projection::window_minimum:
        minimum =
            std::make_unique<MinimumWindow>(projected_hemisphere(directions) ? Domain::hemisphere : Domain::sphere);
        [[fallthrough]];
      case Projection::least_squares:
      case Projection::truncation:
      case Projection::nonnegative:
      case Projection::luma_chroma:
      case Projection::window_hanning:
      case Projection::window_lanczos:
        fit = make_moment_fit(basis, directions, weights);
        break;
      case Projection::ambient_highlight:
        fit = make_ambient_highlight_fit(basis, directions, weights);
        break;
      case Projection::value_at_normal:
      case Projection::through_sh3:
      case Projection::irradiance_sh2:
      case Projection::zonal:
        from_radiance = std::make_unique<Projector>(basis, kMostRadianceCount);
        break;
    }
  }

  std::vector<double> project(std::span<const double> irradiance, std::span<const double> radiance) const {
    const std::string name(basis.name);
    const bool needs_radiance = from_radiance || basis.projection == Projection::ambient_highlight;
    const std::size_t length = std::size_t(kMostRadianceCount) * 3;
    if (irradiance.size() != samples * 3)
      throw UserError("basis " + name + ": " + std::to_string(irradiance.size()) + " numbers of irradiance for " +
                      std::to_string(samples) + " directions; three each are needed");
    if (needs_radiance && radiance.size() != length)
      throw UserError("basis " + name + " is made from radiance: its 36 coefficients are needed");
    check_finite("irradiance", irradiance);
    check_finite("radiance", radiance);
    std::vector<double> coefficients(std::size_t(basis.count) * 3);
    if (from_radiance)
      from_radiance->project(radiance.data(), coefficients.data());
    else
      fit->solve(irradiance.data(), radiance.data(), coefficients.data());
    if (basis.projection == Projection::window_hanning) apply_window(coefficients.data(), hanning_window());
    if (basis.projection == Projection::window_lanczos) apply_window(coefficients.data(), lanczos_window());
    if (minimum) apply_window(coefficients.data(), minimum_window(minimum->strength(coefficients.data())));
    return coefficients;
  }

 private:
  static bool projected_hemisphere(std::span<const glm::dvec3> directions) {
    for (const glm::dvec3& d : directions)
      if (d.z < 0) return false;
    return true;
  }

  void check(std::span<const glm::dvec3> directions, std::span<const double> weights) const {
    TWINSHADE_CHECK_EQ(directions.size(), weights.size());
    for (std::size_t p = 0; p < directions.size(); ++p) {
      const double length = glm::dot(directions[p], directions[p]);
      if (!(std::abs(length - 1) < 1e-3))
        throw UserError("direction " + std::to_string(p) + " is not a unit vector: (" +
                        std::to_string(directions[p].x) + ", " + std::to_string(directions[p].y) + ", " +
                        std::to_string(directions[p].z) + ")");
      if (!(weights[p] >= 0) || !std::isfinite(weights[p]))
        throw UserError("weight " + std::to_string(p) + " is negative or not finite: " + std::to_string(weights[p]));
    }
  }

  void check_finite(const char* what, std::span<const double> values) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        throw UserError(std::string(what) + " sample " + std::to_string(i / 3) + " is " + std::to_string(values[i]) +
                        ": only finite light can be projected");
  }

  TechniqueInfo basis;
  std::size_t samples;
  std::unique_ptr<const SampleFit> fit;
  std::unique_ptr<const MinimumWindow> minimum;
  std::unique_ptr<const Projector> from_radiance;
};

SampleProjector::SampleProjector(const TechniqueInfo& basis, std::span<const glm::dvec3> directions,
                                 std::span<const double> weights)
    : rule_(std::make_unique<Rule>(basis, directions, weights)) {}
SampleProjector::~SampleProjector() = default;
SampleProjector::SampleProjector(SampleProjector&&) noexcept = default;
SampleProjector& SampleProjector::operator=(SampleProjector&&) noexcept = default;

std::vector<double> SampleProjector::project(std::span<const double> irradiance,
                                             std::span<const double> radiance_sh) const {
  return rule_->project(irradiance, radiance_sh);
}

}  // namespace twinshade
