// Weights of visibility from lightmaps, four a texel: layer q of the texture array VISIBILITY has weights 4q to 4q + 3, bilinear,
// clamped to the edge. Includer defines VISIBILITY, as in visibility_sh. load_coefficients() comes before the first weights.
#include "exact/bilinear.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray VISIBILITY;

ExactTaps visibility_taps;  // the same for all layers

void load_coefficients() {
  visibility_taps = exact_taps_clamp(v_lightmap_uv, textureSize(VISIBILITY, 0).xy);
}

vec4 visibility_weights(int quad) {
  return exact_fetch(VISIBILITY, visibility_taps, quad);
}
