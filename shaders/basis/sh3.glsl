// Spherical harmonics of order 3 (l <= 2).
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.
#include "basis/sh_functions.glsl"

const int BASIS_COUNT = 9;

float basis_value(int i, vec3 n) {
  return i == 0   ? sh_0()
         : i == 1 ? sh_1(n)
         : i == 2 ? sh_2(n)
         : i == 3 ? sh_3(n)
         : i == 4 ? sh_4(n)
         : i == 5 ? sh_5(n)
         : i == 6 ? sh_6(n)
         : i == 7 ? sh_7(n)
                  : sh_8(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * sh_0();
  irradiance += COEF(1) * sh_1(n);
  irradiance += COEF(2) * sh_2(n);
  irradiance += COEF(3) * sh_3(n);
  irradiance += COEF(4) * sh_4(n);
  irradiance += COEF(5) * sh_5(n);
  irradiance += COEF(6) * sh_6(n);
  irradiance += COEF(7) * sh_7(n);
  irradiance += COEF(8) * sh_8(n);
  return irradiance;
}
