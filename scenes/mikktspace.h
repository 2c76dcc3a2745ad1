// Tangents as tools that bake normal maps make them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace twinshade {

// One tangent for each corner of each triangle (3 * triangles), xyz unit and orthogonal to the corner's normal,
// w = +1 or -1: bitangent = w * cross(normal, tangent). Corners of one vertex differ where the uvs are mirrored.
// positions, normals (unit), uvs: one for each corner. Corners with equal position, normal and uv are one vertex.
std::vector<glm::vec4> mikktspace_tangents(const std::vector<glm::vec3>& positions,
                                           const std::vector<glm::vec3>& normals, const std::vector<glm::vec2>& uvs);

}  // namespace twinshade
