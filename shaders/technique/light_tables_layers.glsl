// Colours of L x H tables towards a normal: sphere maps of the texture array LIGHT_TABLES, RGB, interleaved as sphere_map_fetch has
// them. Map 0 is the mean's, where there is one; the components' begin at map 4, so that fours of them are whole cache lines.
// Includer defines LIGHT_TABLES; VISIBILITY_COUNT, the maps beside the mean's; VISIBILITY_MEAN, 1 where there is one. After a
// sphere map. light_tables_packed.glsl has the same functions.

uniform sampler2DArray LIGHT_TABLES;

// Of four rows.
struct LightColors {
  vec3 x, y, z, w;
};

SphereMapTaps light_table_taps(vec3 n) {
  return sphere_map_taps(n, textureSize(LIGHT_TABLES, 0).x);
}

int light_table_count() {
  return textureSize(LIGHT_TABLES, 0).z / SPHERE_MAP_LAYERS;
}

vec3 light_table_mean(SphereMapTaps taps) {
  return sphere_map_fetch(LIGHT_TABLES, taps, light_table_count(), 0).rgb;
}

// The maps whose weights are 4 * quad to 4 * quad + 3.
LightColors light_table_quad(SphereMapTaps taps, int quad) {
  mat4 colors = sphere_map_fetch_4(LIGHT_TABLES, taps, light_table_count(), (quad + VISIBILITY_MEAN) * 4);
  return LightColors(colors[0].rgb, colors[1].rgb, colors[2].rgb, colors[3].rgb);
}

// The map beyond all quads.
vec3 light_table_last(SphereMapTaps taps) {
  return sphere_map_fetch(LIGHT_TABLES, taps, light_table_count(), VISIBILITY_COUNT - 1 + VISIBILITY_MEAN * 4).rgb;
}
