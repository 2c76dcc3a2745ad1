// Dual paraboloid map: each hemisphere by stereographic projection onto a disk, the disk as a square. Layer 0 has z >= 0; the
// equator is the outer ring of texel centres of both layers, so the map is continuous across it.
// Heidrich and Seidel, View-Independent Environment Maps, 1998; Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed
// Visibility, JGT 2012, appendix A. direction: unit. width: texels along an edge.
#include "sphere_map/concentric_square.glsl"
#include "sphere_map/edge_aligned.glsl"

const int SPHERE_MAP_LAYERS = 2;

vec3 sphere_map_square(vec3 direction) {
  precise float denominator = 1.0 + abs(direction.z);
  precise vec2 disk = direction.xy / denominator;
  return vec3(disk_to_square(disk), direction.z < 0.0 ? 1.0 : 0.0);
}

vec3 sphere_map_direction(ivec3 texel, int width) {
  vec2 disk = square_to_disk(edge_aligned_square(texel.xy, width));
  precise float squared = disk.x * disk.x + disk.y * disk.y;
  precise float denominator = 1.0 + squared;
  precise float scale = 2.0 / denominator;
  precise vec2 xy = disk * scale;
  precise float height = (1.0 - squared) / denominator;
  bool rim = width > 1 && (min(texel.x, texel.y) == 0 || max(texel.x, texel.y) == width - 1);
  float z = rim ? 0.0 : height;
  return vec3(xy, texel.z == 1 ? -z : z);
}
