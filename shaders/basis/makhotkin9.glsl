// Makhotkin's hemispherical functions of order 3 (l <= 2).
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.
#include "basis/makhotkin_functions.glsl"

const int BASIS_COUNT = 9;

float basis_value(int i, vec3 n) {
  return i == 0 ? makhotkin_0()
         : i == 1 ? makhotkin_1(n)
         : i == 2 ? makhotkin_2(n)
         : i == 3 ? makhotkin_3(n)
         : i == 4 ? makhotkin_4(n)
         : i == 5 ? makhotkin_5(n)
         : i == 6 ? makhotkin_6(n)
         : i == 7 ? makhotkin_7(n)
         : makhotkin_8(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * makhotkin_0();
  irradiance += COEF(1) * makhotkin_1(n);
  irradiance += COEF(2) * makhotkin_2(n);
  irradiance += COEF(3) * makhotkin_3(n);
  irradiance += COEF(4) * makhotkin_4(n);
  irradiance += COEF(5) * makhotkin_5(n);
  irradiance += COEF(6) * makhotkin_6(n);
  irradiance += COEF(7) * makhotkin_7(n);
  irradiance += COEF(8) * makhotkin_8(n);
  return irradiance;
}
