// Normals for models that come without.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace twinshade {

// One unit normal for each corner of each triangle: the mean, weighted by area, over the triangles that share the
// corner's position and lie within the crease angle of the corner's own. cos_crease = 1: flat. A triangle without area
// has (0, 1, 0) where its neighbours give none.
std::vector<glm::vec3> face_normals(const std::vector<glm::vec3>& corner_positions, double cos_crease);

}  // namespace twinshade
