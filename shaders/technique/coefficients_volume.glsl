// Coefficients from an irradiance volume: COEF(i) is blended between the eight probes of a regular grid around the surface point,
// trilinear; outside the grid, its nearest face counts. Includer defines COEFFICIENTS, as in volume_sh3: layer i has
// coefficient i, probe (x, y, z) at texel (x, z * size.y + y); COEFFICIENT_COUNT, the basis' BASIS_COUNT; COEFFICIENTS_PICKED, 1 where
// the basis reads few of them, which depend on the normal. load_coefficients() comes before the first COEF.
// Greger, Shirley, Hubbard and Greenberg, The Irradiance Volume, 1998.
#define FETCHED_COLORS COEFFICIENT_COUNT
#include "exact/fetch_colors.glsl"

in vec3 v_position;             // world space
uniform vec3 volume_origin;     // world position of probe (0, 0, 0)
uniform vec3 volume_scale;      // probes per unit of length, each axis
uniform ivec3 volume_size;      // probes along each axis
uniform sampler2DArray COEFFICIENTS;  // RGB

struct VolumeTaps {
  ExactTaps low, high;  // the four probes below and above
};

// NaN reads probe 0.
float volume_place(float place, int size) {
  precise float last = float(size - 1);
  precise float low = place > 0.0 ? place : 0.0;
  return low < last ? low : last;
}

VolumeTaps volume_taps() {
  precise vec3 place = (v_position - volume_origin) * volume_scale;
  precise vec3 inside = vec3(volume_place(place.x, volume_size.x), volume_place(place.y, volume_size.y),
                             volume_place(place.z, volume_size.z));
  ivec3 low = ivec3(inside);
  ivec3 high = min(low + 1, volume_size - 1);
  precise vec3 fraction = inside - vec3(low);
  vec4 weight = exact_bilinear_weights(fraction.xy);
  int low_row = low.z * volume_size.y;
  int high_row = high.z * volume_size.y;
  precise vec4 low_weight = weight * (1.0 - fraction.z);
  precise vec4 high_weight = weight * fraction.z;
  VolumeTaps taps;
  taps.low = ExactTaps(ivec4(low.x, low_row + low.y, high.x, low_row + high.y), low_weight);
  taps.high = ExactTaps(ivec4(low.x, high_row + low.y, high.x, high_row + high.y), high_weight);
  return taps;
}

#if COEFFICIENTS_PICKED
VolumeTaps coefficient_taps;

void load_coefficients() {
  coefficient_taps = volume_taps();
}

#define COEF(i) exact_fetch_sum(COEFFICIENTS, coefficient_taps.low, coefficient_taps.high, i)
#define COEF_ONES(i, ones) exact_fetch_ones(COEFFICIENTS, coefficient_taps.low, coefficient_taps.high, i, ones)
#define COEF_THREES(i, threes) exact_fetch_threes(COEFFICIENTS, coefficient_taps.low, coefficient_taps.high, i, threes)
#else
vec3 coefficients[COEFFICIENT_COUNT];

void load_coefficients() {
  VolumeTaps taps = volume_taps();
  exact_fetch_colors(COEFFICIENTS, taps.low, taps.high, coefficients);
}

#define COEF(i) coefficients[i]
#endif
