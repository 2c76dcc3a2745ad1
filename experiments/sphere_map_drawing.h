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

// Who weighs the texels: the shader, or the machine's textureLod, in cubes without and with the neighbouring faces.
enum class MapFilter { written_out, driver, driver_seamless };

// What `machine` reads of `functions` maps at each direction: [direction * functions + function].
// driver_seamless: cubes only. texels: [texel * functions + function]. directions: rounded to float, unit.
std::vector<float> draw_reads(const std::string& machine, const DrawFunction& draw, const SphereMapGrid& grid,
                              MapFilter filter, std::span<const float> texels, int functions,
                              std::span<const glm::vec3> directions);

}  // namespace twinshade
