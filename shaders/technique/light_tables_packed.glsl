// Colours of L x H tables towards a normal, from one ordinary texture, as hardware without texture arrays has them (DirectX 9): four
// values a texel. A band of the texture is a sphere map with its layers side by side, the two hemispheres of a dual map for one. From
// the bottom: the mean (RGB of one row), then for each four rows their red, their green and their blue, then a row that is left
// (RGB). Three fetches where rows on their own need four, and the same bits. Iwanicki and Sloan, Normal Mapping with Low-Frequency
// Precomputed Visibility, JGT 2012. Includer defines what light_tables_layers.glsl says.

#define LIGHT_TABLE_ALL 0

uniform sampler2D LIGHT_TABLES;

// Of four rows.
struct LightColors {
  vec3 x, y, z, w;
};

int light_table_width() {
  return textureSize(LIGHT_TABLES, 0).x / SPHERE_MAP_LAYERS;
}

SphereMapTaps light_table_taps(vec3 n) {
  return sphere_map_taps(n, light_table_width());
}

vec4 light_table_band(SphereMapTaps taps, int band) {
  return sphere_map_fetch(LIGHT_TABLES, taps, light_table_width(), band);
}

vec3 light_table_mean(SphereMapTaps taps) {
  return light_table_band(taps, 0).rgb;
}

// The rows whose weights are 4 * quad to 4 * quad + 3.
LightColors light_table_quad(SphereMapTaps taps, int quad) {
  int band = quad * 3 + VISIBILITY_MEAN;
  vec4 red = light_table_band(taps, band);
  vec4 green = light_table_band(taps, band + 1);
  vec4 blue = light_table_band(taps, band + 2);
  return LightColors(vec3(red.x, green.x, blue.x), vec3(red.y, green.y, blue.y), vec3(red.z, green.z, blue.z),
                     vec3(red.w, green.w, blue.w));
}

// The row beyond all quads.
vec3 light_table_last(SphereMapTaps taps) {
  return light_table_band(taps, VISIBILITY_COUNT / 4 * 3 + VISIBILITY_MEAN).rgb;
}

// The only row.
vec3 light_table_only(SphereMapTaps taps) {
  return light_table_band(taps, 0).rgb;
}
