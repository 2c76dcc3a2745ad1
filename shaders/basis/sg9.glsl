// Nine spherical Gaussians, about the vertices of a tricapped triangular prism, the nearest of them acos(1/3) apart:
//   i = 0..2: (cos p, sin p, 0), p = 60, 180, 300 degrees
//   i = 3..5: (2/3 cos p, 2/3 sin p, sqrt5/3), p = 0, 120, 240 degrees;  i = 6..8: the same, z negative
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.
#include "basis/sg_functions.glsl"

const int BASIS_COUNT = 9;

// n along the directions at 0, 120 and 240 degrees; the opposite ones are those at 180, 300 and 60.
vec3 sg9_spokes(vec3 n) {
  precise float half_x = n.x * 0.5;
  precise float side = n.y * 0.866025404;  // sqrt3/2
  precise float second = side - half_x;
  precise float third = -side - half_x;
  return vec3(n.x, second, third);
}

// Cosines to the axes of i = 3..5 (z: n.z) or 6..8 (z: -n.z).
vec3 sg9_cosines(vec3 spokes, float z) {
  precise vec3 cosines = spokes * 0.666666667 + z * 0.745355992;  // 2/3, sqrt5/3
  return cosines;
}

float basis_value(int i, vec3 n) {
  vec3 spokes = sg9_spokes(n);
  vec3 cosines = i < 3   ? vec3(-spokes.z, -spokes.x, -spokes.y)
                 : i < 6 ? sg9_cosines(spokes, n.z)
                         : sg9_cosines(spokes, -n.z);
  int place = i < 3 ? i : i < 6 ? i - 3 : i - 6;
  return sg_lobe(place == 0 ? cosines.x : place == 1 ? cosines.y : cosines.z);
}

vec3 basis_irradiance(vec3 n) {
  vec3 spokes = sg9_spokes(n);
  vec3 above = sg9_cosines(spokes, n.z);
  vec3 below = sg9_cosines(spokes, -n.z);
  precise vec3 irradiance = COEF(0) * sg_lobe(-spokes.z);
  irradiance += COEF(1) * sg_lobe(-spokes.x);
  irradiance += COEF(2) * sg_lobe(-spokes.y);
  irradiance += COEF(3) * sg_lobe(above.x);
  irradiance += COEF(4) * sg_lobe(above.y);
  irradiance += COEF(5) * sg_lobe(above.z);
  irradiance += COEF(6) * sg_lobe(below.x);
  irradiance += COEF(7) * sg_lobe(below.y);
  irradiance += COEF(8) * sg_lobe(below.z);
  return irradiance;
}
