// Colours of L x H tables towards a normal. Row r is the sphere map from layer r * SPHERE_MAP_LAYERS of the texture array
// LIGHT_TABLES, RGB; the mean's row comes first. Includer defines LIGHT_TABLES; VISIBILITY_COUNT, the rows beside the mean;
// VISIBILITY_MEAN, 1 where there is one. After a sphere map. light_tables_packed.glsl has the same functions.

uniform sampler2DArray LIGHT_TABLES;

// Of four rows.
struct LightColors {
  vec3 x, y, z, w;
};

SphereMapTaps light_table_taps(vec3 n) {
  return sphere_map_taps(n, textureSize(LIGHT_TABLES, 0).x);
}

vec3 light_table(SphereMapTaps taps, int row) {
  return sphere_map_fetch(LIGHT_TABLES, taps, row * SPHERE_MAP_LAYERS).rgb;
}

vec3 light_table_mean(SphereMapTaps taps) {
  return light_table(taps, 0);
}

// The rows whose weights are 4 * quad to 4 * quad + 3.
LightColors light_table_quad(SphereMapTaps taps, int quad) {
  int row = quad * 4 + VISIBILITY_MEAN;
  return LightColors(light_table(taps, row), light_table(taps, row + 1), light_table(taps, row + 2), light_table(taps, row + 3));
}

// The row beyond all quads.
vec3 light_table_last(SphereMapTaps taps) {
  return light_table(taps, VISIBILITY_COUNT - 1 + VISIBILITY_MEAN);
}
