// Coefficients from lightmaps: COEF(i) is layer i of the texture array COEFFICIENTS, bilinear, clamped to the edge.
// Includer defines COEFFICIENTS, as in coefficients_h4, and COEFFICIENT_COUNT, the basis' BASIS_COUNT. load_coefficients() comes
// before the first COEF.
#include "exact/bilinear.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray COEFFICIENTS;  // RGB

vec3 coefficients[(COEFFICIENT_COUNT + 4) / 5 * 5];

void load_coefficients() {
  ExactTaps taps = exact_taps_clamp(v_lightmap_uv, textureSize(COEFFICIENTS, 0).xy);
#if COEFFICIENT_COUNT == 1
  coefficients[0] = exact_fetch(COEFFICIENTS, taps, 0).rgb;
#else
  for (int five = 0; five < (COEFFICIENT_COUNT + 4) / 5; ++five) {
    vec3 layers[5] = exact_fetch_5(COEFFICIENTS, taps, five);
    for (int k = 0; k < 5; ++k) coefficients[five * 5 + k] = layers[k];
  }
#endif
}

#define COEF(i) coefficients[i]
