// Colours of L x H tables towards a normal: sphere maps of the texture array LIGHT_TABLES, RGB, interleaved as sphere_map_fetch has
// them, their number filled up to whole fives unless there is but one. Map 0 is the mean's, where there is one.
// Includer defines LIGHT_TABLES; VISIBILITY_COUNT, the maps beside the mean's; VISIBILITY_MEAN, 1 where there is one. After a
// sphere map. light_tables_packed.glsl is its rival: LIGHT_TABLE_FIVES says which.

#define LIGHT_TABLE_FIVES 1

uniform sampler2DArray LIGHT_TABLES;

SphereMapTaps light_table_taps(vec3 n) {
  return sphere_map_taps(n, textureSize(LIGHT_TABLES, 0).x);
}

int light_table_count() {
  return textureSize(LIGHT_TABLES, 0).z / SPHERE_MAP_LAYERS;
}

// Maps 5 * five to 5 * five + 4.
vec3[5] light_table_five(SphereMapTaps taps, int five) {
  return sphere_map_fetch_5(LIGHT_TABLES, taps, light_table_count(), five);
}

// The only map.
vec3 light_table_only(SphereMapTaps taps) {
  return sphere_map_fetch(LIGHT_TABLES, taps, 1, 0).rgb;
}
