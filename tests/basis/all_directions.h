// Directions that bases may trip over, and the two properties that hold for all of them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "tests/basis/support.h"

namespace twinshade::test {

// Axes and octant corners with zeros of both signs, vertices, middles of edges and faces of the icosahedron, all of
// them also one float step aside; the zero vector; NaN.
std::vector<glm::dvec3> special_directions();

// Of float components: uniform, or within a few float steps of a vertex, an edge or a coordinate plane.
glm::dvec3 awkward_direction(Uniform& uniform);

// Directions at which irradiance in float is NaN or infinite; the first few are printed.
int count_not_finite(const TechniqueInfo& basis, const std::vector<glm::dvec3>& directions);

// Directions for which shaders/basis/ambient_dice_functions.glsl, in float, does not pick a face that contains them,
// found by trying all faces, or not their barycentric coordinates, or a negative one; the first few are printed.
int count_wrong_triangles(const std::vector<glm::dvec3>& directions);

}  // namespace twinshade::test
