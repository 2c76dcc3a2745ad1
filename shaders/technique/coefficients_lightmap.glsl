// Coefficients from lightmaps: COEF(i) is layer i of the texture array COEFFICIENTS, bilinear, clamped to the edge.
// Includer defines COEFFICIENTS, as in coefficients_h4, and COEFFICIENT_COUNT, the basis' BASIS_COUNT. load_coefficients() comes
// before the first COEF.
#define FETCHED_COLORS COEFFICIENT_COUNT
#include "exact/fetch_colors.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray COEFFICIENTS;  // RGB

vec3 coefficients[COEFFICIENT_COUNT];

void load_coefficients() {
  ExactTaps taps = exact_taps_clamp(v_lightmap_uv, textureSize(COEFFICIENTS, 0).xy);
#if COEFFICIENT_COUNT == 1
  coefficients[0] = exact_fetch(COEFFICIENTS, taps, 0).rgb;
#else
  exact_fetch_colors(COEFFICIENTS, taps, coefficients);
#endif
}

#define COEF(i) coefficients[i]
