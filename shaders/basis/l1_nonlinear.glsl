// Non-linear L1: a power of the half cosine with the mean and, nearly, the first moment of irradiance, never negative. Hazel,
// Reconstructing Diffuse Lighting from Spherical Harmonic Data, Geomerics, CEDEC 2015; used by Enlighten. Per channel, with R0
// the mean of irradiance over the sphere and R1 half the gradient of its linear part (R0 + 2 R1 . n), |R1| <= R0:
//   E = R0 (a + (1 - a)(p + 1) q^p), q = (1 + n . R1/|R1|)/2, p = 1 + 2 |R1|/R0, a = (R0 - |R1|)/(R0 + |R1|)
// R0 where R1 is zero or too small to square; 0 where R0 is not positive; |R1| > R0, which only coefficients blended or rounded
// can have, counts as R0.
// Includer defines COEF(i): irradiance in spherical harmonics l <= 1, index l*l + l + m, factor (-1)^m, as vec3. n: unit normal.
#include "exact/dot.glsl"
#include "exact/pow.glsl"

const int BASIS_COUNT = 4;

float l1_nonlinear_channel(vec3 n, float c0, vec3 c1) {
  precise float mean = c0 * 0.282094792;   // sqrt(1/4pi)
  precise vec3 half_slope = c1 * 0.244301256;  // sqrt(3/4pi)/2
  precise float square = exact_dot(half_slope, half_slope);
  bool directed = square > 1.17549435e-38;  // 2^-126
  precise float size = sqrt(directed ? square : 1.0);
  precise float cosine = exact_dot(half_slope, n) / size;
  precise float q = 0.5 + 0.5 * cosine;
  q = q > 0.0 ? q : 0.0;
  precise float length_of_half_slope = mix(mean, size, size < mean);
  precise float ratio = length_of_half_slope / mean;
  precise float p = 1.0 + 2.0 * ratio;
  precise float a = (1.0 - ratio) / (1.0 + ratio);
  precise float scale = (1.0 - a) * (p + 1.0);
  precise float irradiance = mean * (a + scale * exact_pow(q, p));
  return mean > 0.0 ? (directed ? irradiance : mean) : 0.0;
}

vec3 basis_irradiance(vec3 n) {
  vec3 c0 = COEF(0);
  vec3 c1 = COEF(1);
  vec3 c2 = COEF(2);
  vec3 c3 = COEF(3);
  return vec3(l1_nonlinear_channel(n, c0.x, vec3(-c3.x, -c1.x, c2.x)),
              l1_nonlinear_channel(n, c0.y, vec3(-c3.y, -c1.y, c2.y)),
              l1_nonlinear_channel(n, c0.z, vec3(-c3.z, -c1.z, c2.z)));
}
