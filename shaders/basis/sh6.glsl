// Spherical harmonics of order 6 (l <= 5). Radiance of irradiance volumes is baked on these.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.
#include "basis/sh_functions.glsl"
#include "basis/sh_bands_3_4.glsl"
#include "basis/sh_bands_5.glsl"

const int BASIS_COUNT = 36;

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
         : i == 15 ? sh_15(n)
         : i == 16 ? sh_16(n)
         : i == 17 ? sh_17(n)
         : i == 18 ? sh_18(n)
         : i == 19 ? sh_19(n)
         : i == 20 ? sh_20(n)
         : i == 21 ? sh_21(n)
         : i == 22 ? sh_22(n)
         : i == 23 ? sh_23(n)
         : i == 24 ? sh_24(n)
         : i == 25 ? sh_25(n)
         : i == 26 ? sh_26(n)
         : i == 27 ? sh_27(n)
         : i == 28 ? sh_28(n)
         : i == 29 ? sh_29(n)
         : i == 30 ? sh_30(n)
         : i == 31 ? sh_31(n)
         : i == 32 ? sh_32(n)
         : i == 33 ? sh_33(n)
         : i == 34 ? sh_34(n)
         : sh_35(n);
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
  irradiance += COEF(16) * sh_16(n);
  irradiance += COEF(17) * sh_17(n);
  irradiance += COEF(18) * sh_18(n);
  irradiance += COEF(19) * sh_19(n);
  irradiance += COEF(20) * sh_20(n);
  irradiance += COEF(21) * sh_21(n);
  irradiance += COEF(22) * sh_22(n);
  irradiance += COEF(23) * sh_23(n);
  irradiance += COEF(24) * sh_24(n);
  irradiance += COEF(25) * sh_25(n);
  irradiance += COEF(26) * sh_26(n);
  irradiance += COEF(27) * sh_27(n);
  irradiance += COEF(28) * sh_28(n);
  irradiance += COEF(29) * sh_29(n);
  irradiance += COEF(30) * sh_30(n);
  irradiance += COEF(31) * sh_31(n);
  irradiance += COEF(32) * sh_32(n);
  irradiance += COEF(33) * sh_33(n);
  irradiance += COEF(34) * sh_34(n);
  irradiance += COEF(35) * sh_35(n);
  return irradiance;
}
