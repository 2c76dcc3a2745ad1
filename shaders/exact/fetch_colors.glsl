// All layers of a map at once, RGB. Includer defines FETCHED_COLORS, how many; past the map's last one, the last one.
#include "exact/bilinear.glsl"

void exact_fetch_colors(sampler2DArray maps, ExactTaps taps, out vec3 colors[FETCHED_COLORS]) {
  int last = textureSize(maps, 0).z - 1;
  for (int i = 0; i < FETCHED_COLORS; ++i) colors[i] = exact_fetch(maps, taps, min(i, last)).rgb;
}

// Sums of what two taps read.
void exact_fetch_colors(sampler2DArray maps, ExactTaps low, ExactTaps high, out vec3 colors[FETCHED_COLORS]) {
  int last = textureSize(maps, 0).z - 1;
  for (int i = 0; i < FETCHED_COLORS; ++i) {
    precise vec3 sum = exact_fetch(maps, low, min(i, last)).rgb + exact_fetch(maps, high, min(i, last)).rgb;
    colors[i] = sum;
  }
}
