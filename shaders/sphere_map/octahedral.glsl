// Octahedral map: the sphere projected onto an octahedron, its lower half folded out into a square. Texel centres on the edge, so
// that the fold is continuous; an odd width puts texels on the poles and axes.
// Engelhardt and Dachsbacher, Octahedron Environment Maps, 2008. direction: of any length but zero. width: texels along an edge.
#include "exact/normalize.glsl"
#include "sphere_map/edge_aligned.glsl"

const int SPHERE_MAP_LAYERS = 1;

// Between a point of the lower half and the place where it is folded to, either way.
vec2 octahedral_fold(vec2 p) {
  precise vec2 folded = 1.0 - abs(p.yx);
  return vec2(p.x < 0.0 ? -folded.x : folded.x, p.y < 0.0 ? -folded.y : folded.y);
}

vec3 sphere_map_square(vec3 direction) {
  precise float sum = (abs(direction.x) + abs(direction.y)) + abs(direction.z);
  precise vec2 square = direction.xy / sum;
  return vec3(direction.z < 0.0 ? octahedral_fold(square) : square, 0.0);
}

vec3 sphere_map_direction(ivec3 texel, int width) {
  vec2 square = edge_aligned_square(texel.xy, width);
  precise float z = (1.0 - abs(square.x)) - abs(square.y);
  return exact_normalize(vec3(z < 0.0 ? octahedral_fold(square) : square, z));
}
