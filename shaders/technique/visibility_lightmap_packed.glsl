// Weights of visibility from one ordinary texture, four a texel, as hardware without texture arrays has them (DirectX 9): square
// lightmaps side by side, the q-th with weights 4q to 4q + 3, each bilinear within itself. Includer defines VISIBILITY, as in
// visibility_sh. load_coefficients() comes before the first weights.
#include "exact/bilinear.glsl"

in vec2 v_lightmap_uv;
uniform sampler2D VISIBILITY;

ExactTaps visibility_taps;  // of the first lightmap

void load_coefficients() {
  visibility_taps = exact_taps_clamp(v_lightmap_uv, textureSize(VISIBILITY, 0).yy);
}

vec4 visibility_weights(int quad) {
  int beside = quad * textureSize(VISIBILITY, 0).y;
  return exact_fetch(VISIBILITY, ExactTaps(visibility_taps.texel + ivec4(beside, 0, beside, 0), visibility_taps.weight));
}
