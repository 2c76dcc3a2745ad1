// Ambient Dice, linear: 12 values on the vertices of an icosahedron, 3 read, weighted by spherical barycentric
// coordinates: linear functions are exact, a constant is not. Iwanicki and Sloan, Ambient Dice, EGSR 2017, section 3.
// Includer defines COEF(i): coefficient i as vec3, the irradiance at vertex i. n: unit normal.
#include "basis/ambient_dice_functions.glsl"

const int BASIS_COUNT = 12;

float basis_value(int i, vec3 n) {
  DiceTriangle triangle = dice_triangle(n);
  return i == triangle.vertex.x   ? triangle.barycentric.x
         : i == triangle.vertex.y ? triangle.barycentric.y
         : i == triangle.vertex.z ? triangle.barycentric.z
                                  : 0.0;
}

vec3 basis_irradiance(vec3 n) {
  DiceTriangle triangle = dice_triangle(n);
  vec3 values[3];
  COEF_ONES(triangle.vertex, values);
  precise vec3 irradiance = values[0] * triangle.barycentric.x;
  irradiance += values[1] * triangle.barycentric.y;
  irradiance += values[2] * triangle.barycentric.z;
  return irradiance;
}
