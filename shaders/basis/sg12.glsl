// Twelve spherical Gaussians, about the vertices of an icosahedron, numbered as in ambient_dice_functions.glsl.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.
#include "basis/ambient_dice_functions.glsl"
#include "basis/sg_functions.glsl"

const int BASIS_COUNT = 12;

float basis_value(int i, vec3 n) {
  return sg_lobe(dice_cosine(dice_cosines(n), i));
}

vec3 basis_irradiance(vec3 n) {
  DiceCosines cosines = dice_cosines(n);
  precise vec3 irradiance = COEF(0) * sg_lobe(cosines.first.x);
  irradiance += COEF(1) * sg_lobe(cosines.second.x);
  irradiance += COEF(2) * sg_lobe(-cosines.second.x);
  irradiance += COEF(3) * sg_lobe(-cosines.first.x);
  irradiance += COEF(4) * sg_lobe(cosines.first.y);
  irradiance += COEF(5) * sg_lobe(cosines.second.y);
  irradiance += COEF(6) * sg_lobe(-cosines.second.y);
  irradiance += COEF(7) * sg_lobe(-cosines.first.y);
  irradiance += COEF(8) * sg_lobe(cosines.first.z);
  irradiance += COEF(9) * sg_lobe(cosines.second.z);
  irradiance += COEF(10) * sg_lobe(-cosines.second.z);
  irradiance += COEF(11) * sg_lobe(-cosines.first.z);
  return irradiance;
}
