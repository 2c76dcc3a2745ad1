// Hemispherical harmonics of order 3 (l <= 2).
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.
#include "basis/hsh_functions.glsl"

const int BASIS_COUNT = 9;

float basis_value(int i, vec3 n) {
  return i == 0 ? hsh_0()
         : i == 1 ? hsh_1(n)
         : i == 2 ? hsh_2(n)
         : i == 3 ? hsh_3(n)
         : i == 4 ? hsh_4(n)
         : i == 5 ? hsh_5(n)
         : i == 6 ? hsh_6(n)
         : i == 7 ? hsh_7(n)
         : hsh_8(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * hsh_0();
  irradiance += COEF(1) * hsh_1(n);
  irradiance += COEF(2) * hsh_2(n);
  irradiance += COEF(3) * hsh_3(n);
  irradiance += COEF(4) * hsh_4(n);
  irradiance += COEF(5) * hsh_5(n);
  irradiance += COEF(6) * hsh_6(n);
  irradiance += COEF(7) * hsh_7(n);
  irradiance += COEF(8) * hsh_8(n);
  return irradiance;
}
