// Ambient Dice with lobes: each of the 12 vertices contributes dice_lobe(cosine between it and n) where that cosine is not
// negative, so one of each pair of opposite vertices: 6 coefficients read. Includer defines float dice_lobe(float cosine).
#include "basis/ambient_dice_functions.glsl"

const int BASIS_COUNT = 12;

float basis_value(int i, vec3 n) {
  float cosine = dice_cosine(dice_cosines(n), i);
  return cosine > 0.0 ? dice_lobe(cosine) : 0.0;
}

vec3 basis_irradiance(vec3 n) {
  DiceCosines cosines = dice_cosines(n);
  precise vec3 irradiance = (cosines.first.x < 0.0 ? COEF(3) : COEF(0)) * dice_lobe(cosines.first.x);
  irradiance += (cosines.second.x < 0.0 ? COEF(2) : COEF(1)) * dice_lobe(cosines.second.x);
  irradiance += (cosines.first.y < 0.0 ? COEF(7) : COEF(4)) * dice_lobe(cosines.first.y);
  irradiance += (cosines.second.y < 0.0 ? COEF(6) : COEF(5)) * dice_lobe(cosines.second.y);
  irradiance += (cosines.first.z < 0.0 ? COEF(11) : COEF(8)) * dice_lobe(cosines.first.z);
  irradiance += (cosines.second.z < 0.0 ? COEF(10) : COEF(9)) * dice_lobe(cosines.second.z);
  return irradiance;
}
