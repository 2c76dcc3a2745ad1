// Texel i of width W at 2i / (W - 1) - 1: the outermost texel centres lie on the edge of the square [-1, 1]^2, so a map whose edge
// folds onto itself or onto another layer is continuous across it.
#include "exact/bilinear.glsl"
#include "sphere_map/taps.glsl"

// -1 to 1; 0 where the width is 1.
vec2 edge_aligned_square(ivec2 texel, int width) {
  precise vec2 numerator = vec2(texel * 2 - (width - 1));
  precise float denominator = float(max(width - 1, 1));
  precise vec2 square = numerator / denominator;
  return square;
}

// Where a direction meets the map: -1 to 1 both ways, and the layer. Of the map that includes this file.
vec3 sphere_map_square(vec3 direction);

// NaN reads texel 0; what is outside the square, its edge.
SphereMapTaps edge_aligned_taps(vec2 square, int width, int layer) {
  precise float last = float(width - 1);
  precise float half_last = last * 0.5;
  precise vec2 position = square * half_last + half_last;
  precise float u = position.x > 0.0 ? position.x : 0.0;
  precise float v = position.y > 0.0 ? position.y : 0.0;
  u = u < last ? u : last;
  v = v < last ? v : last;
  ivec2 low = ivec2(int(u), int(v));
  ivec2 high = min(low + 1, width - 1);
  precise vec2 fraction = vec2(u, v) - vec2(low);
  return sphere_map_block(low, high, layer, exact_bilinear_weights(fraction));
}

SphereMapTaps sphere_map_taps(vec3 direction, int width) {
  vec3 square = sphere_map_square(direction);
  return edge_aligned_taps(square.xy, width, int(square.z));
}
