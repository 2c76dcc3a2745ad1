// Octahedral map that keeps areas: equal squares are equal solid angles. Texel centres on the edge, so that the fold is continuous.
// Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, 2008. direction: unit. width: texels along an edge.
#include "exact/atan2.glsl"
#include "exact/sin_cos.glsl"
#include "sphere_map/edge_aligned.glsl"

const int SPHERE_MAP_LAYERS = 1;

vec3 sphere_map_square(vec3 direction) {
  vec3 extent = abs(direction);
  // 1 - |z|, which next to the poles would leave nothing but the rounding of z.
  precise float across = extent.x * extent.x + extent.y * extent.y;
  precise float cap = across / (1.0 + extent.z);
  precise float radius = sqrt(min(cap, 1.0));
  precise float turn = exact_atan2(extent.y, extent.x) * 0.636619772;  // 2/pi
  precise float y = radius * turn;
  precise float x = radius - y;
  precise vec2 folded = vec2(1.0 - y, 1.0 - x);
  vec2 square = direction.z < 0.0 ? folded : vec2(x, y);
  return vec3(direction.x < 0.0 ? -square.x : square.x, direction.y < 0.0 ? -square.y : square.y, 0.0);
}

vec3 sphere_map_direction(ivec3 texel, int width) {
  vec2 square = edge_aligned_square(texel.xy, width);
  vec2 extent = abs(square);
  precise float above = (1.0 - extent.x) - extent.y;
  precise float radius = 1.0 - abs(above);
  precise float share = (extent.y - extent.x) / radius;
  precise float angle = (radius > 0.0 ? share + 1.0 : 0.0) * 0.785398163;  // pi/4
  precise float squared = radius * radius;
  precise float height = 1.0 - squared;
  precise float across = radius * sqrt(2.0 - squared);
  precise float x = across * exact_cos(angle);
  precise float y = across * exact_sin(angle);
  return vec3(square.x < 0.0 ? -x : x, square.y < 0.0 ? -y : y, above < 0.0 ? -height : height);
}
