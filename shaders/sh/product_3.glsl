// Product of two functions given by spherical harmonics of order 3 (l <= 2), cut to order 3: the 25 different integrals of three
// functions that are not zero. Sloan, Stupid Spherical Harmonics (SH) Tricks, 2008; NMV section 3.1.

vec3[9] sh3_product(vec3 a[9], float b[9]) {
  precise vec3 c0 = ((((((((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]) + a[3] * b[3]) + a[4] * b[4]) + a[5] * b[5])
      + a[6] * b[6]) + a[7] * b[7]) + a[8] * b[8]) * 0.282094792;  // sqrt(1/4pi)
  precise vec3 c1 = (a[0] * b[1] + a[1] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c1 += (((a[2] * b[5] + a[5] * b[2]) + (a[3] * b[4] + a[4] * b[3])) - (a[1] * b[8]
      + a[8] * b[1])) * 0.218509686;  // sqrt(3/20pi)
  c1 += (a[1] * b[6] + a[6] * b[1]) * -0.126156626;  // -sqrt(1/20pi)
  precise vec3 c2 = (a[0] * b[2] + a[2] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c2 += (a[2] * b[6] + a[6] * b[2]) * 0.252313252;  // sqrt(1/5pi)
  c2 += ((a[1] * b[5] + a[5] * b[1]) + (a[3] * b[7] + a[7] * b[3])) * 0.218509686;  // sqrt(3/20pi)
  precise vec3 c3 = (a[0] * b[3] + a[3] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c3 += (((a[1] * b[4] + a[4] * b[1]) + (a[2] * b[7] + a[7] * b[2])) + (a[3] * b[8]
      + a[8] * b[3])) * 0.218509686;  // sqrt(3/20pi)
  c3 += (a[3] * b[6] + a[6] * b[3]) * -0.126156626;  // -sqrt(1/20pi)
  precise vec3 c4 = (a[0] * b[4] + a[4] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c4 += (a[1] * b[3] + a[3] * b[1]) * 0.218509686;  // sqrt(3/20pi)
  c4 += (a[4] * b[6] + a[6] * b[4]) * -0.180223752;  // -sqrt(5/49pi)
  c4 += (a[5] * b[7] + a[7] * b[5]) * 0.156078347;  // sqrt(15/196pi)
  precise vec3 c5 = (a[0] * b[5] + a[5] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c5 += (a[1] * b[2] + a[2] * b[1]) * 0.218509686;  // sqrt(3/20pi)
  c5 += ((a[4] * b[7] + a[7] * b[4]) - (a[5] * b[8] + a[8] * b[5])) * 0.156078347;  // sqrt(15/196pi)
  c5 += (a[5] * b[6] + a[6] * b[5]) * 0.0901118758;  // sqrt(5/196pi)
  precise vec3 c6 = (a[0] * b[6] + a[6] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c6 += (a[2] * b[2]) * 0.252313252;  // sqrt(1/5pi)
  c6 += (a[6] * b[6] - (a[4] * b[4] + a[8] * b[8])) * 0.180223752;  // sqrt(5/49pi)
  c6 += (a[1] * b[1] + a[3] * b[3]) * -0.126156626;  // -sqrt(1/20pi)
  c6 += (a[5] * b[5] + a[7] * b[7]) * 0.0901118758;  // sqrt(5/196pi)
  precise vec3 c7 = (a[0] * b[7] + a[7] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c7 += (a[2] * b[3] + a[3] * b[2]) * 0.218509686;  // sqrt(3/20pi)
  c7 += ((a[4] * b[5] + a[5] * b[4]) + (a[7] * b[8] + a[8] * b[7])) * 0.156078347;  // sqrt(15/196pi)
  c7 += (a[6] * b[7] + a[7] * b[6]) * 0.0901118758;  // sqrt(5/196pi)
  precise vec3 c8 = (a[0] * b[8] + a[8] * b[0]) * 0.282094792;  // sqrt(1/4pi)
  c8 += (a[3] * b[3] - a[1] * b[1]) * 0.218509686;  // sqrt(3/20pi)
  c8 += (a[6] * b[8] + a[8] * b[6]) * -0.180223752;  // -sqrt(5/49pi)
  c8 += (a[7] * b[7] - a[5] * b[5]) * 0.156078347;  // sqrt(15/196pi)
  return vec3[9](c0, c1, c2, c3, c4, c5, c6, c7, c8);
}
