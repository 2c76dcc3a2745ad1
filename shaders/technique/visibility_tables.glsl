// Irradiance as visibility's weights times the colours of L x H tables towards the normal, world space. Row r of the tables is
// the sphere map from layer r * SPHERE_MAP_LAYERS. Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility,
// JGT 2012, sections 3.1 and 3.2. Includer defines LIGHT_TABLES, the texture array; VISIBILITY_COUNT, the weights, at least 4;
// VISIBILITY_MEAN, 1 where row 0 belongs to the mean, whose weight is 1. After a sphere map and visibility_lightmap.glsl or
// visibility_vertex.glsl.

uniform sampler2DArray LIGHT_TABLES;  // RGB

vec3 light_table(SphereMapTaps taps, int row) {
  return sphere_map_fetch(LIGHT_TABLES, taps, row * SPHERE_MAP_LAYERS).rgb;
}

// n: unit normal.
vec3 basis_irradiance(vec3 n) {
  SphereMapTaps taps = sphere_map_taps(n, textureSize(LIGHT_TABLES, 0).x);
  vec4 weights = visibility_weights(0);
  precise vec3 irradiance = light_table(taps, VISIBILITY_MEAN) * weights.x;
#if VISIBILITY_MEAN
  irradiance += light_table(taps, 0);
#endif
  irradiance += light_table(taps, VISIBILITY_MEAN + 1) * weights.y;
  irradiance += light_table(taps, VISIBILITY_MEAN + 2) * weights.z;
  irradiance += light_table(taps, VISIBILITY_MEAN + 3) * weights.w;
  for (int quad = 1; quad < VISIBILITY_COUNT / 4; ++quad) {
    int row = quad * 4 + VISIBILITY_MEAN;
    weights = visibility_weights(quad);
    irradiance += light_table(taps, row) * weights.x;
    irradiance += light_table(taps, row + 1) * weights.y;
    irradiance += light_table(taps, row + 2) * weights.z;
    irradiance += light_table(taps, row + 3) * weights.w;
  }
#if VISIBILITY_COUNT % 4 == 1
  irradiance += light_table(taps, VISIBILITY_COUNT - 1 + VISIBILITY_MEAN) * visibility_weights(VISIBILITY_COUNT / 4).x;
#endif
  return irradiance;
}
