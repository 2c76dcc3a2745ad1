// AHD, ambient and highlight direction: constant light and one directional light. id Software, Quake III light grid, 1999;
// Iwanicki and Sloan, Precomputed Lighting in Call of Duty: Infinite Warfare, SIGGRAPH 2017.
// Includer defines COEF(i), vec3: 0 ambient irradiance, RGB; 1 irradiance of the highlight at a surface that faces it, RGB;
// 2 direction towards the highlight, of any length (blended probes shorten it); where it is zero there is no highlight.
// n: unit normal.
#include "exact/dot.glsl"

const int BASIS_COUNT = 3;

vec3 basis_irradiance(vec3 n) {
  vec3 direction = COEF(2);
  precise float square = exact_dot(direction, direction);
  precise float cosine = exact_dot(n, direction) / sqrt(square);
  cosine = square > 1.17549435e-38 && cosine > 0.0 ? cosine : 0.0;  // 2^-126
  precise vec3 irradiance = COEF(0) + COEF(1) * cosine;
  return irradiance;
}
