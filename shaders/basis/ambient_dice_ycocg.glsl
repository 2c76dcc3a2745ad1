// Ambient Dice in YCoCg: luma Y by spherical Bezier patches, chroma Co and Cg linear with spherical barycentric coordinates, all
// on the vertices of an icosahedron. Iwanicki and Sloan, Ambient Dice, EGSR 2017, section 5. Reads 6.
//   Y = R/4 + G/2 + B/4, Co = R/2 - B/2, Cg = G/2 - R/4 - B/4;   R = Y + Co - Cg, G = Y + Cg, B = Y - Co - Cg
// Includer defines COEF(i), vec3 of numbers that are no colours, of vertex v (ambient_dice_functions.glsl):
//   COEF(v)      = (Y, dY/de1, dY/de2), v = 0..11
//   COEF(12 + v) = (Co, Cg, unused): two of three components, so that one read has both
// 60 numbers in all, of which an evaluation needs 15. n: unit normal.
#include "basis/ambient_dice_bezier_functions.glsl"
#include "exact/dot.glsl"

const int BASIS_COUNT = 24;

vec3 basis_irradiance(vec3 n) {
  DiceTriangle triangle = dice_triangle(n);
  DiceWeights weights = dice_spherical_weights(triangle);
  precise float luma = exact_dot(COEF(weights.vertex.x), weights.first) + exact_dot(COEF(weights.vertex.y), weights.second);
  luma += exact_dot(COEF(weights.vertex.z), weights.third);
  precise vec3 chroma = COEF(12 + triangle.vertex.x) * triangle.barycentric.x;
  chroma += COEF(12 + triangle.vertex.y) * triangle.barycentric.y;
  chroma += COEF(12 + triangle.vertex.z) * triangle.barycentric.z;
  precise float green = luma + chroma.y;
  precise float rest = luma - chroma.y;
  precise float red = rest + chroma.x;
  precise float blue = rest - chroma.x;
  return vec3(red, green, blue);
}
