// Dual orthographic map: each hemisphere projected along z onto a disk, the disk as a square. Layer 0 has z >= 0; the equator is the
// outer ring of texel centres of both layers, so the map is continuous across it.
// Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, appendix A.
// direction: unit. width: texels along an edge.
#include "sphere_map/concentric_square.glsl"
#include "sphere_map/edge_aligned.glsl"

const int SPHERE_MAP_LAYERS = 2;

vec3 sphere_map_square(vec3 direction) {
  return vec3(disk_to_square(direction.xy), direction.z < 0.0 ? 1.0 : 0.0);
}

vec3 sphere_map_direction(ivec3 texel, int width) {
  vec2 disk = square_to_disk(edge_aligned_square(texel.xy, width));
  precise float squared = 1.0 - (disk.x * disk.x + disk.y * disk.y);
  bool rim = width > 1 && (min(texel.x, texel.y) == 0 || max(texel.x, texel.y) == width - 1);
  precise float z = sqrt(rim || squared < 0.0 ? 0.0 : squared);
  return vec3(disk, texel.z == 1 ? -z : z);
}
