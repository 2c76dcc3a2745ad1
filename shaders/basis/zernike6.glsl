// Zernike polynomials of degree <= 2 on the hemisphere.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.
#include "basis/zernike_functions.glsl"

const int BASIS_COUNT = 6;

float basis_value(int i, vec3 n) {
  return i == 0 ? zernike_1()
         : i == 1 ? zernike_2(n)
         : i == 2 ? zernike_3(n)
         : i == 3 ? zernike_4(n)
         : i == 4 ? zernike_5(n)
         : zernike_6(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * zernike_1();
  irradiance += COEF(1) * zernike_2(n);
  irradiance += COEF(2) * zernike_3(n);
  irradiance += COEF(3) * zernike_4(n);
  irradiance += COEF(4) * zernike_5(n);
  irradiance += COEF(5) * zernike_6(n);
  return irradiance;
}
