// A lattice cut out of the surface by discard: round holes, eight to a unit of v_uv; what is left is shaded with H4.
// TWINSHADE_VERTEX_COEFFICIENTS: coefficients come from the vertices.
#define COEFFICIENTS coefficients_h4
#define COEFFICIENT_COUNT 4
#include "technique/surface.glsl"
#ifdef TWINSHADE_VERTEX_COEFFICIENTS
#include "technique/coefficients_vertex.glsl"
#else
#include "technique/coefficients_lightmap.glsl"
#endif
#include "basis/h4.glsl"
#include "exact/dot.glsl"
#include "exact/fract.glsl"
#include "technique/reflected_light.glsl"

out vec4 color;

void main() {
  precise vec2 lattice = v_uv * 8.0;
  precise vec2 from_centre = exact_fract(lattice) - 0.5;
  precise float distance_squared = exact_dot(from_centre, from_centre);
  if (distance_squared < 0.0900000000) discard;  // 0.3^2
  color = vec4(reflected_light(), 1.0);
}
