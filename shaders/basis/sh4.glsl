// Spherical harmonics of order 4 (l <= 3).
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.
#include "basis/sh_functions.glsl"
#include "basis/sh_bands_3_4.glsl"

const int BASIS_COUNT = 16;

float basis_value(int i, vec3 n) {
  return i == 0 ? sh_0()
         : i == 1 ? sh_1(n)
         : i == 2 ? sh_2(n)
         : i == 3 ? sh_3(n)
         : i == 4 ? sh_4(n)
         : i == 5 ? sh_5(n)
         : i == 6 ? sh_6(n)
         : i == 7 ? sh_7(n)
         : i == 8 ? sh_8(n)
         : i == 9 ? sh_9(n)
         : i == 10 ? sh_10(n)
         : i == 11 ? sh_11(n)
         : i == 12 ? sh_12(n)
         : i == 13 ? sh_13(n)
         : i == 14 ? sh_14(n)
         : sh_15(n);
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
  irradiance += COEF(9) * sh_9(n);
  irradiance += COEF(10) * sh_10(n);
  irradiance += COEF(11) * sh_11(n);
  irradiance += COEF(12) * sh_12(n);
  irradiance += COEF(13) * sh_13(n);
  irradiance += COEF(14) * sh_14(n);
  irradiance += COEF(15) * sh_15(n);
  return irradiance;
}
