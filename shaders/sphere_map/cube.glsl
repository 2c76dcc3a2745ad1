// Cube map filtered across edges and corners, as hardware does since DirectX 10: a tap beyond an edge is the border texel of the
// adjacent face at the same place along the edge; of the three faces that meet in a corner the missing fourth tap is the mean.
// Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, appendix A.
// direction: of any length. width: texels along an edge.
#include "sphere_map/cube_face.glsl"

// A texel of `face`, or one beyond one of its edges: where it lies. Twice the texel coordinates on a cube of edge 2 * width are
// whole numbers; folding the row beyond an edge onto the adjacent face moves it by one along two axes.
ivec3 cube_texel(int face, ivec2 texel, int width) {
  ivec2 q = texel * 2 + (1 - width);
  bool beyond_s = texel.x < 0 || texel.x >= width;
  bool beyond_t = texel.y < 0 || texel.y >= width;
  ivec3 folded = beyond_s   ? ivec3(texel.x < 0 ? -width : width, q.y, width - 1)
                 : beyond_t ? ivec3(q.x, texel.y < 0 ? -width : width, width - 1)
                            : ivec3(q, width);
  ivec3 point = cube_from_face(face, folded);
  int there = abs(point.x) == width ? (point.x < 0 ? 1 : 0) : abs(point.y) == width ? (point.y < 0 ? 3 : 2) : (point.z < 0 ? 5 : 4);
  ivec2 place = (cube_to_face(there, point).xy + (width - 1)) >> 1;
  return ivec3(clamp(place, ivec2(0), ivec2(width - 1)), there);  // beyond two edges there is no texel: the weight is 0
}

// Where some of the four are beyond an edge. weight: of a block of the face.
SphereMapTaps cube_taps_across_edges(int face, ivec2 low, vec4 weight, int width) {
  ivec2 high = low + 1;
  SphereMapTaps taps;
  taps.texel_00 = cube_texel(face, low, width);
  taps.texel_10 = cube_texel(face, ivec2(high.x, low.y), width);
  taps.texel_01 = cube_texel(face, ivec2(low.x, high.y), width);
  taps.texel_11 = cube_texel(face, high, width);

  bool right = high.x >= width;
  bool top = high.y >= width;
  bool corner = (low.x < 0 || right) && (low.y < 0 || top);
  precise float missing = top ? (right ? weight.w : weight.z) : (right ? weight.y : weight.x);
  precise vec4 dealt = weight + missing * 0.333333343;  // 1/3
  dealt.x = top || right ? dealt.x : 0.0;
  dealt.y = top || !right ? dealt.y : 0.0;
  dealt.z = !top || right ? dealt.z : 0.0;
  dealt.w = !top || !right ? dealt.w : 0.0;
  taps.weight = corner ? dealt : weight;
  return taps;
}

SphereMapTaps sphere_map_taps(vec3 direction, int width) {
  int face = cube_face(direction);
  vec2 position = cube_position(face, direction, width);
  precise vec2 cell = floor(position);
  precise vec2 fraction = position - cell;
  ivec2 low = ivec2(cell);
  ivec2 high = low + 1;
  SphereMapTaps taps = sphere_map_block(low, high, face, exact_bilinear_weights(fraction));
  if (low.x < 0 || low.y < 0 || high.x >= width || high.y >= width)
    taps = cube_taps_across_edges(face, low, taps.weight, width);
  return taps;
}
