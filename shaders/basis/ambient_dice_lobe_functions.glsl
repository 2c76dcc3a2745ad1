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
  precise vec3 irradiance = COEF(cosines.first.x < 0.0 ? 3 : 0) * dice_lobe(cosines.first.x);
  irradiance += COEF(cosines.second.x < 0.0 ? 2 : 1) * dice_lobe(cosines.second.x);
  irradiance += COEF(cosines.first.y < 0.0 ? 7 : 4) * dice_lobe(cosines.first.y);
  irradiance += COEF(cosines.second.y < 0.0 ? 6 : 5) * dice_lobe(cosines.second.y);
  irradiance += COEF(cosines.first.z < 0.0 ? 11 : 8) * dice_lobe(cosines.first.z);
  irradiance += COEF(cosines.second.z < 0.0 ? 10 : 9) * dice_lobe(cosines.second.z);
  return irradiance;
}
