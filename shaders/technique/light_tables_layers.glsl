// Colours of L x H tables towards a normal: sphere maps of the texture array LIGHT_TABLES, RGB, interleaved as sphere_map_fetch has
// them, their number filled up to whole fives unless there is but one. Map 0 is the mean's, where there is one.
// Includer defines LIGHT_TABLES; VISIBILITY_COUNT, the maps beside the mean's; VISIBILITY_MEAN, 1 where there is one. After a
// sphere map. light_tables_packed.glsl is its rival: LIGHT_TABLE_ALL says which.

#define LIGHT_TABLE_ALL 1
#define SPHERE_MAP_COLORS (VISIBILITY_COUNT + VISIBILITY_MEAN)
#include "sphere_map/fetch_colors.glsl"

uniform sampler2DArray LIGHT_TABLES;

vec3 light_table_colors[SPHERE_MAP_COLORS];

SphereMapTaps light_table_taps(vec3 n) {
  return sphere_map_taps(n, textureSize(LIGHT_TABLES, 0).x);
}

int light_table_count() {
  return textureSize(LIGHT_TABLES, 0).z / SPHERE_MAP_LAYERS;
}

// Fills light_table_colors. n: unit normal.
void load_light_tables(vec3 n) {
  sphere_map_fetch_colors(LIGHT_TABLES, light_table_taps(n), light_table_count(), light_table_colors);
}

// The only map.
vec3 light_table_only(SphereMapTaps taps) {
  return sphere_map_fetch(LIGHT_TABLES, taps, 1, 0).rgb;
}
