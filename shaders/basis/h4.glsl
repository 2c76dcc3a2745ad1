// H4: the first four functions of the H-basis, the span of spherical harmonics l <= 1 on the hemisphere.
// Habel and Wimmer, Efficient Irradiance Normal Mapping, I3D 2010, eqs. 8-11.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.
#include "basis/h_functions.glsl"

const int BASIS_COUNT = 4;

float basis_value(int i, vec3 n) {
  return i == 0 ? h_1() : i == 1 ? h_2(n) : i == 2 ? h_3(n) : h_4(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = COEF(0) * h_1();
  irradiance += COEF(1) * h_2(n);
  irradiance += COEF(2) * h_3(n);
  irradiance += COEF(3) * h_4(n);
  return irradiance;
}
