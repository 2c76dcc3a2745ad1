// Weights of visibility from lightmaps, four a texel: layer q of the texture array VISIBILITY has weights 4q to 4q + 3, bilinear,
// clamped to the edge. Includer defines VISIBILITY, as in visibility_sh, and VISIBILITY_COUNT, the weights. load_coefficients() comes
// before the first weights.
#include "exact/bilinear.glsl"

in vec2 v_lightmap_uv;
uniform sampler2DArray VISIBILITY;

const int VISIBILITY_LAYERS = (VISIBILITY_COUNT + 3) / 4;

vec4 visibility_layers[(VISIBILITY_LAYERS + 3) / 4 * 4];

void load_coefficients() {
  ExactTaps taps = exact_taps_clamp(v_lightmap_uv, textureSize(VISIBILITY, 0).xy);
  int layer = 0;
  for (; layer + 1 < VISIBILITY_LAYERS; layer += 4) {
    mat4 layers = exact_fetch_4(VISIBILITY, taps, layer);
    visibility_layers[layer] = layers[0];
    visibility_layers[layer + 1] = layers[1];
    visibility_layers[layer + 2] = layers[2];
    visibility_layers[layer + 3] = layers[3];
  }
  if (layer < VISIBILITY_LAYERS) visibility_layers[layer] = exact_fetch(VISIBILITY, taps, layer);
}

vec4 visibility_weights(int quad) {
  return visibility_layers[quad];
}
