// Ambient Dice, spherical cubic Bezier patches: 12 values and gradients on the vertices of an icosahedron, 9 coefficients read.
// Iwanicki and Sloan, Ambient Dice, EGSR 2017, section 4.
// C1 on the sphere; linear functions of the normal are exact, a constant comes back as 0.938 to 1 of itself.
// Includer defines COEF(i): coefficient i as vec3, i = 3 vertex + {value, d/de1, d/de2}. n: unit normal.
#include "basis/ambient_dice_bezier_functions.glsl"

const int BASIS_COUNT = 36;

float basis_value(int i, vec3 n) {
  return dice_weight(dice_spherical_weights(dice_triangle(n)), i);
}

vec3 basis_irradiance(vec3 n) {
  DiceWeights weights = dice_spherical_weights(dice_triangle(n));
  ivec3 base = weights.vertex * 3;
  mat3 vertex = COEF_3(base.x);
  precise vec3 irradiance = vertex[0] * weights.first.x;
  irradiance += vertex[1] * weights.first.y;
  irradiance += vertex[2] * weights.first.z;
  vertex = COEF_3(base.y);
  irradiance += vertex[0] * weights.second.x;
  irradiance += vertex[1] * weights.second.y;
  irradiance += vertex[2] * weights.second.z;
  vertex = COEF_3(base.z);
  irradiance += vertex[0] * weights.third.x;
  irradiance += vertex[1] * weights.third.y;
  irradiance += vertex[2] * weights.third.z;
  return irradiance;
}
