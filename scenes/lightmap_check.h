// Whether a model's second uvs can hold a lightmap.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace twinshade {

// Empty if every uv lies in [0, 1], no sample of a 1024 x 1024 grid lies inside two triangles, and no triangle with an
// area in space is without one in the map; else the reason, as "... lie outside [0, 1]".
std::string lightmap_fault(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& uvs,
                           const std::vector<std::uint32_t>& indices);

}  // namespace twinshade
