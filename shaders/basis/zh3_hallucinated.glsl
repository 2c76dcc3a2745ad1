// ZH3, hallucinated: the zonal coefficient of l = 2 guessed from l <= 1, by a fit to single lights and skies. Roughton, Sloan,
// Silvennoinen, Iwanicki and Shirley, ZH3: Quadratic Zonal Harmonics, I3D 2024, section 3.4.3: of radiance, per channel,
//   L_2 = L_0 (0.08 r + 0.6 r^2), r = |L_1 . axis| / L_0, and irradiance from radiance by pi, 2pi/3, pi/4:
//   E_2 = E_0 / 4 (0.08 r + 0.6 r^2), r = 3/2 |E_1 . axis| / E_0 = 0.03 |E_1 . axis| + 0.3375 |E_1 . axis|^2 / E_0
// Nothing is added where E_0 is not positive, or where l = 1 has no luminance and thus no axis. r is at most sqrt3, a single
// light: more, which only coefficients blended or rounded can have, counts as that.
// Includer defines COEF(i): irradiance in spherical harmonics l <= 1, as vec3. n: unit normal.
#include "basis/zh3_functions.glsl"

const int BASIS_COUNT = 4;

float zh3_guess(float constant, vec3 towards, vec3 axis) {
  precise float along = abs(exact_dot(towards, axis));
  precise float most = constant * 1.15470054;  // sqrt3 2/3
  along = mix(most, along, along < most);
  precise float ratio = along / constant;
  precise float guess = along * (ratio * 0.337500000 + 0.0300000000);  // 0.6 9/16, 0.08 3/8
  return constant > 0.0 ? guess : 0.0;
}

vec3 basis_irradiance(vec3 n) {
  vec3 c0 = COEF(0);
  vec3 c1 = COEF(1);
  vec3 c2 = COEF(2);
  vec3 c3 = COEF(3);
  vec3 axis = zh3_axis(c1, c2, c3);
  vec3 zonal = vec3(zh3_guess(c0.x, vec3(-c3.x, -c1.x, c2.x), axis), zh3_guess(c0.y, vec3(-c3.y, -c1.y, c2.y), axis),
                    zh3_guess(c0.z, vec3(-c3.z, -c1.z, c2.z), axis));
  precise vec3 irradiance = zh3_linear(n, c0, c1, c2, c3);
  irradiance += zonal * zh3_zonal(n, axis);
  return irradiance;
}
