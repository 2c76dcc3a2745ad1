// Directional occlusion: one vector per channel, dotted with the normal. Habel and Wimmer, Efficient Irradiance Normal Mapping,
// I3D 2010, section 2. The axes of tangent space times sqrt(3 / 2pi) are orthonormal on the hemisphere; the frame of the
// Half-Life 2 basis is a rotation of them, so both span the same functions and reproduce the same irradiance.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.

const int BASIS_COUNT = 3;

float directional_occlusion_value(float axis) {
  precise float value = axis * 0.690988299;  // sqrt(3 / 2pi)
  return value;
}

float basis_value(int i, vec3 n) {
  return directional_occlusion_value(i == 0 ? n.x : i == 1 ? n.y : n.z);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = (COEF(0) * directional_occlusion_value(n.x) + COEF(1) * directional_occlusion_value(n.y)) +
                            COEF(2) * directional_occlusion_value(n.z);
  return irradiance;
}
