// Coefficients from lightmaps: COEF(i) is layer i of the texture array COEFFICIENTS, bilinear, clamped to the edge.
// Includer defines COEFFICIENTS, as in coefficients_h4, and COEFFICIENT_COUNT, the basis' BASIS_COUNT. load_coefficients() comes
// before the first COEF.
#include "exact/bilinear.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray COEFFICIENTS;  // RGB

vec3 coefficients[(COEFFICIENT_COUNT + 3) / 4 * 4];

void load_coefficients() {
  ExactTaps taps = exact_taps_clamp(v_lightmap_uv, textureSize(COEFFICIENTS, 0).xy);
#if COEFFICIENT_COUNT % 4 == 1
  const int SINGLE = COEFFICIENT_COUNT - 1;
  coefficients[SINGLE] = exact_fetch(COEFFICIENTS, taps, SINGLE).rgb;
#else
  const int SINGLE = COEFFICIENT_COUNT;
#endif
  for (int i = 0; i < SINGLE; i += 4) {
    mat4 layers = exact_fetch_4(COEFFICIENTS, taps, i);
    coefficients[i] = layers[0].rgb;
    coefficients[i + 1] = layers[1].rgb;
    coefficients[i + 2] = layers[2].rgb;
    coefficients[i + 3] = layers[3].rgb;
  }
}

#define COEF(i) coefficients[i]
