// Cube map filtered within each face, clamped at its edges, as hardware of the DirectX 9 generation did: seams at the edges.
// Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, appendix A.
// direction: of any length. width: texels along an edge.
#include "sphere_map/cube_face.glsl"

SphereMapTaps sphere_map_taps(vec3 direction, int width) {
  int face = cube_face(direction);
  vec2 position = cube_position(face, direction, width);
  precise vec2 cell = floor(position);
  precise vec2 fraction = position - cell;
  ivec2 low = ivec2(cell);
  ivec2 high = min(low + 1, width - 1);
  low = max(low, ivec2(0));
  return sphere_map_block(low, high, face, exact_bilinear_weights(fraction));
}
