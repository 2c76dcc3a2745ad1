// In place of sphere_map/edge_aligned.glsl where OpenGL is timed.
#include "sphere_map/taps.glsl"

vec2 edge_aligned_square(ivec2 texel, int width) {
  return vec2(texel * 2 - (width - 1)) / float(max(width - 1, 1));
}

vec3 sphere_map_square(vec3 direction);

SphereMapTaps sphere_map_taps(vec3 direction, int width) {
  vec3 square = sphere_map_square(direction);
  float size = float(width);
  return SphereMapTaps((square.xy * (0.5 * (size - 1.0)) + 0.5 * size) / size, int(square.z));
}
