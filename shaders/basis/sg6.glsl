// Six spherical Gaussians, about +x, +y, +z, -x, -y, -z.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.
#include "basis/sg_functions.glsl"

const int BASIS_COUNT = 6;

float basis_value(int i, vec3 n) {
  int axis = i < 3 ? i : i - 3;
  float component = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  return sg_lobe(i < 3 ? component : -component);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * sg_lobe(n.x);
  irradiance += COEF(1) * sg_lobe(n.y);
  irradiance += COEF(2) * sg_lobe(n.z);
  irradiance += COEF(3) * sg_lobe(-n.x);
  irradiance += COEF(4) * sg_lobe(-n.y);
  irradiance += COEF(5) * sg_lobe(-n.z);
  return irradiance;
}
