// ZH3: spherical harmonics l <= 1 and one coefficient of l = 2. Roughton, Sloan, Silvennoinen, Iwanicki and Shirley, ZH3:
// Quadratic Zonal Harmonics, I3D 2024.
// Includer defines COEF(i), vec3: 0 to 3 irradiance in spherical harmonics l <= 1; 4 its coefficient, per channel, of the
// function sqrt(5/16pi) (3 cos^2 - 1) about the axis of zh3_functions.glsl: sqrt(4pi/5) (sum over m of E_2m Y_2m(axis)). Where
// l = 1 has no luminance there is no axis, and 4 does not count. n: unit normal.
#include "basis/zh3_functions.glsl"

const int BASIS_COUNT = 5;

vec3 basis_irradiance(vec3 n) {
  vec3 c0 = COEF(0);
  vec3 c1 = COEF(1);
  vec3 c2 = COEF(2);
  vec3 c3 = COEF(3);
  precise vec3 irradiance = zh3_linear(n, c0, c1, c2, c3);
  irradiance += COEF(4) * zh3_zonal(n, zh3_axis(c1, c2, c3));
  return irradiance;
}
