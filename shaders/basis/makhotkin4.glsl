// Makhotkin's hemispherical functions of order 2 (l <= 1).
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.
#include "basis/makhotkin_functions.glsl"

const int BASIS_COUNT = 4;

float basis_value(int i, vec3 n) {
  return i == 0 ? makhotkin_0()
         : i == 1 ? makhotkin_1(n)
         : i == 2 ? makhotkin_2(n)
         : makhotkin_3(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * makhotkin_0();
  irradiance += COEF(1) * makhotkin_1(n);
  irradiance += COEF(2) * makhotkin_2(n);
  irradiance += COEF(3) * makhotkin_3(n);
  return irradiance;
}
