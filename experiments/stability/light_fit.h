// Lights whose irradiance is known in closed form, and what a basis makes of them.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lighting/projection.h"
#include "lighting/quadrature.h"

namespace twinshade {

// Constant radiance all around and distant suns: E(n) = constant + sum of strength max(0, n . direction), RGB. Numbers
// may be negative: not all that is projected is light.
struct SmallLight {
  struct Sun {
    glm::dvec3 direction;  // unit
    glm::dvec3 strength{1};
  };
  std::string name;  // what it is, for people
  glm::dvec3 constant{0};
  std::vector<Sun> suns{};

  glm::dvec3 irradiance(const glm::dvec3& n) const;
  std::vector<double> radiance() const;  // 36 real SH, [j * 3 + channel]
};

// A sun facing which irradiance is 1, named after its direction.
SmallLight unit_sun(const glm::dvec3& direction);

// For one thread at a time: what fits is made when first asked for.
class LightFit {
 public:
  // `basis` must be a basis, and outlive this.
  explicit LightFit(const TechniqueInfo& basis) : basis_(basis) {}

  // Coefficients [i * 3 + channel], each rounded to float as it would be stored, by the registry's projection: fitted
  // to the irradiance, or from the radiance in closed form, all of it. (Bakes cut radiance to l <= 4 first.)
  std::vector<double> coefficients(const SmallLight& light) const;

 private:
  void prepare() const;

  const TechniqueInfo& basis_;
  mutable Quadrature points_;
  mutable std::optional<SampleProjector> samples_;
  mutable std::optional<Projector> radiance_;  // neither: the irradiance at (0, 0, 1)
};

}  // namespace twinshade
