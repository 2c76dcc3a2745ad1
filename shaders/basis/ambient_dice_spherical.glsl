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
  return dice_irradiance(dice_spherical_weights(dice_triangle(n)));
}
