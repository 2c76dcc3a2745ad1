// Irradiance of the environment without any shadow, by the normal (one table), times the visible part of the hemisphere.
// Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, section 5. As visibility_tables.glsl.

uniform sampler2DArray LIGHT_TABLES;  // RGB

// n: unit normal.
vec3 basis_irradiance(vec3 n) {
  SphereMapTaps taps = sphere_map_taps(n, textureSize(LIGHT_TABLES, 0).x);
  precise vec3 irradiance = sphere_map_fetch(LIGHT_TABLES, taps, 0).rgb * visibility_weights(0).x;
  return irradiance;
}
