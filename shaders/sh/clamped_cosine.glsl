// The clamped cosine about n as spherical harmonics l <= 2: A_l Y_lm(n).
// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001, eq. 8.
#include "basis/sh_functions.glsl"

float[9] clamped_cosine_sh3(vec3 n) {
  float cosine[9];
  cosine[0] = 0.886226925;  // pi sqrt(1/4pi)
  precise float c1 = sh_1(n) * 2.09439510;  // 2pi/3
  precise float c2 = sh_2(n) * 2.09439510;
  precise float c3 = sh_3(n) * 2.09439510;
  precise float c4 = sh_4(n) * 0.785398163;  // pi/4
  precise float c5 = sh_5(n) * 0.785398163;
  precise float c6 = sh_6(n) * 0.785398163;
  precise float c7 = sh_7(n) * 0.785398163;
  precise float c8 = sh_8(n) * 0.785398163;
  cosine[1] = c1;
  cosine[2] = c2;
  cosine[3] = c3;
  cosine[4] = c4;
  cosine[5] = c5;
  cosine[6] = c6;
  cosine[7] = c7;
  cosine[8] = c8;
  return cosine;
}
