// Irradiance as visibility's weights times the colours of L x H tables towards the normal, world space. Iwanicki and Sloan, Normal
// Mapping with Low-Frequency Precomputed Visibility, JGT 2012, sections 3.1 and 3.2. Includer defines VISIBILITY_COUNT, the weights,
// at least 4, and VISIBILITY_MEAN, 1 where one row belongs to the mean, whose weight is 1. After visibility_lightmap.glsl or
// visibility_vertex.glsl, a sphere map and light_tables_layers.glsl or light_tables_packed.glsl, whose LIGHT_TABLE_ALL says whether all rows are read at once.

// n: unit normal.
#if LIGHT_TABLE_ALL
vec3 basis_irradiance(vec3 n) {
  load_light_tables(n);
  precise vec3 irradiance = light_table_colors[VISIBILITY_MEAN] * visibility_weights(0).x;
#if VISIBILITY_MEAN
  irradiance += light_table_colors[0];
#endif
  for (int i = 1; i < VISIBILITY_COUNT; ++i)
    irradiance += light_table_colors[i + VISIBILITY_MEAN] * visibility_weights(i / 4)[i & 3];
  return irradiance;
}
#else
vec3 basis_irradiance(vec3 n) {
  SphereMapTaps taps = light_table_taps(n);
  vec4 weights = visibility_weights(0);
  LightColors colors = light_table_quad(taps, 0);
  precise vec3 irradiance = colors.x * weights.x;
#if VISIBILITY_MEAN
  irradiance += light_table_mean(taps);
#endif
  irradiance += colors.y * weights.y;
  irradiance += colors.z * weights.z;
  irradiance += colors.w * weights.w;
  for (int quad = 1; quad < VISIBILITY_COUNT / 4; ++quad) {
    weights = visibility_weights(quad);
    colors = light_table_quad(taps, quad);
    irradiance += colors.x * weights.x;
    irradiance += colors.y * weights.y;
    irradiance += colors.z * weights.z;
    irradiance += colors.w * weights.w;
  }
#if VISIBILITY_COUNT % 4 == 1
  irradiance += light_table_last(taps) * visibility_weights(VISIBILITY_COUNT / 4).x;
#endif
  return irradiance;
}
#endif
