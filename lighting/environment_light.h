// Integrals over an environment: every pixel is a light in the direction of its centre that weighs its exact solid
// angle.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scenes/environment.h"

namespace twinshade {

// All: world space, RGB. UserError where the environment has no pixels or a pixel that is NaN, infinite or negative.

// Radiance as real SH, l < order (1 to 6): [j * 3 + c].
std::vector<double> environment_radiance(const Environment& environment, int order);

// Irradiance of surfaces with these unit normals, [p * 3 + c]: the sum over all pixels, no SH in between. Pixels times
// normals is what it costs. UserError where a normal is zero or not finite.
std::vector<double> environment_irradiance(const Environment& environment, std::span<const glm::dvec3> normals);

}  // namespace twinshade
