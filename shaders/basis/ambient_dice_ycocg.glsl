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
  vec3 lumas[3];
  COEF_ONES(weights.vertex, lumas);
  precise float luma = exact_dot(lumas[0], weights.first) + exact_dot(lumas[1], weights.second);
  luma += exact_dot(lumas[2], weights.third);
  ivec3 chroma_place = triangle.vertex + 12;
  vec3 chromas[3];
  COEF_ONES(chroma_place, chromas);
  precise vec3 chroma = chromas[0] * triangle.barycentric.x;
  chroma += chromas[1] * triangle.barycentric.y;
  chroma += chromas[2] * triangle.barycentric.z;
  precise float green = luma + chroma.y;
  precise float rest = luma - chroma.y;
  precise float red = rest + chroma.x;
  precise float blue = rest - chroma.x;
  return vec3(red, green, blue);
}
