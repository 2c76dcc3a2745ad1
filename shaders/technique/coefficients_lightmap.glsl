// Coefficients from lightmaps: COEF(i) is layer i of the texture array COEFFICIENTS, bilinear, clamped to the edge.
// Includer defines COEFFICIENTS, as in coefficients_h4. load_coefficients() comes before the first COEF.
#include "exact/bilinear.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray COEFFICIENTS;  // RGB

ExactTaps coefficient_taps;  // the same for all layers

void load_coefficients() {
  coefficient_taps = exact_taps_clamp(v_lightmap_uv, textureSize(COEFFICIENTS, 0).xy);
}

#define COEF(i) exact_fetch(COEFFICIENTS, coefficient_taps, i).rgb
