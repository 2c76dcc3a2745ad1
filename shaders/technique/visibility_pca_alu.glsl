// Irradiance without tables: light seen through each principal component of visibility, as SH l <= 2, blended by the surface's
// weights and convolved with the clamped cosine here. Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed
// Visibility, JGT 2012, section 5. Includer defines VISIBILITY_COUNT, the components. After visibility_lightmap.glsl or
// visibility_vertex.glsl.
#include "sh/clamped_cosine.glsl"

// Coefficient k of light times component m - 1 at 9 m + k; m = 0: times the mean.
uniform vec3 light_components[9 * (VISIBILITY_COUNT + 1)];

// n: unit normal.
vec3 basis_irradiance(vec3 n) {
  float cosine[9] = clamped_cosine_sh3(n);
  precise vec3 irradiance = light_components[0] * cosine[0];
  for (int k = 1; k < 9; ++k) irradiance += light_components[k] * cosine[k];
  for (int quad = 0; quad < VISIBILITY_COUNT / 4; ++quad) {
    vec4 weights = visibility_weights(quad);
    int first = quad * 36 + 9;
    precise vec3 x = light_components[first] * cosine[0];
    precise vec3 y = light_components[first + 9] * cosine[0];
    precise vec3 z = light_components[first + 18] * cosine[0];
    precise vec3 w = light_components[first + 27] * cosine[0];
    for (int k = 1; k < 9; ++k) {
      x += light_components[first + k] * cosine[k];
      y += light_components[first + 9 + k] * cosine[k];
      z += light_components[first + 18 + k] * cosine[k];
      w += light_components[first + 27 + k] * cosine[k];
    }
    irradiance += x * weights.x;
    irradiance += y * weights.y;
    irradiance += z * weights.z;
    irradiance += w * weights.w;
  }
  return irradiance;
}
