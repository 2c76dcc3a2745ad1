// Sphere maps read by the renderers: a frame whose every pixel looks up one direction, so that machines can be compared
// bit by bit.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "lighting/sphere_map_grid.h"

namespace twinshade {

// What `machine` reads of `functions` maps at each direction: [direction * functions + function].
// texels: [texel * functions + function]. directions: rounded to float, unit.
std::vector<float> draw_reads(const std::string& machine, const DrawFunction& draw, const SphereMapGrid& grid,
                              std::span<const float> texels, int functions, std::span<const glm::vec3> directions);

}  // namespace twinshade
