// Irradiance of the environment without any shadow, by the normal (one table), times the visible part of the hemisphere.
// Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, section 5. As visibility_tables.glsl.

// n: unit normal.
vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = light_table_only(light_table_taps(n)) * visibility_weights(0).x;
  return irradiance;
}
