// Weights of visibility from lightmaps, four a texel: layer q of the texture array VISIBILITY has weights 4q to 4q + 3, bilinear,
// clamped to the edge. Includer defines VISIBILITY, as in visibility_sh, and VISIBILITY_COUNT, the weights. load_coefficients() comes
// before the first weights.
#define FETCHED_LAYERS ((VISIBILITY_COUNT + 3) / 4)
#include "exact/fetch_layers.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray VISIBILITY;

vec4 visibility_layers[FETCHED_LAYERS];

void load_coefficients() {
  ExactTaps taps = exact_taps_clamp(v_lightmap_uv, textureSize(VISIBILITY, 0).xy);
#if FETCHED_LAYERS == 1
  visibility_layers[0] = exact_fetch(VISIBILITY, taps, 0);
#else
  exact_fetch_layers(VISIBILITY, taps, visibility_layers);
#endif
}

vec4 visibility_weights(int quad) {
  return visibility_layers[quad];
}
