// Irradiance from light and visibility of order 2 (l <= 1), multiplied here. Iwanicki and Sloan, Normal Mapping with Low-
// Frequency Precomputed Visibility, JGT 2012, section 5. After visibility_lightmap.glsl or visibility_vertex.glsl.
#include "basis/sh_functions.glsl"
#include "sh/product_2.glsl"

uniform vec3 light_sh2[4];  // radiance of the environment, world space

// n: unit normal.
vec3 basis_irradiance(vec3 n) {
  vec4 visibility = visibility_weights(0);
  vec3 seen[4] = sh2_product(light_sh2, visibility);
  precise vec3 irradiance = (seen[0] * sh_0()) * 3.14159265;  // A_0 = pi
  precise vec3 linear = seen[1] * sh_1(n) + seen[2] * sh_2(n);
  linear += seen[3] * sh_3(n);
  irradiance += linear * 2.09439510;  // A_1 = 2pi/3
  return irradiance;
}
