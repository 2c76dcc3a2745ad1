// All layers of a map at once, RGBA. Includer defines FETCHED_LAYERS, how many; past the map's last one, the last one.
#include "exact/bilinear.glsl"

void exact_fetch_layers(sampler2DArray maps, ExactTaps taps, out vec4 layers[FETCHED_LAYERS]) {
  int last = textureSize(maps, 0).z - 1;
  for (int i = 0; i < FETCHED_LAYERS; ++i) layers[i] = exact_fetch(maps, taps, min(i, last));
}
