// Zernike polynomials of the disk, taken to the hemisphere by an equal-area map: orthonormal there. Koenderink, van Doorn and
// Stavridi, Bidirectional Reflection Distribution Function expressed in terms of surface scattering modes, ECCV 1996. With
// q = 1/sqrt(1 + z), all over sqrt(2pi): 1, 2xq, 2yq, sqrt3 (1 - 2z), sqrt6 (x^2 - y^2) q^2, 2 sqrt6 xy q^2.
// Below the horizon z counts as 0, NaN too.

float zernike_height(vec3 n) {
  return n.z > 0.0 ? n.z : 0.0;
}

float zernike_q(vec3 n) {
  precise float q = 1.0 / sqrt(1.0 + zernike_height(n));
  return q;
}

float zernike_1() {
  return 0.398942280;  // 1/sqrt(2pi)
}

float zernike_2(vec3 n) {
  precise float value = (n.x * zernike_q(n)) * 0.797884561;  // 2/sqrt(2pi)
  return value;
}

float zernike_3(vec3 n) {
  precise float value = (n.y * zernike_q(n)) * 0.797884561;  // 2/sqrt(2pi)
  return value;
}

float zernike_4(vec3 n) {
  precise float value = 0.690988299 - zernike_height(n) * 1.38197660;  // sqrt(3/2pi) (1 - 2z)
  return value;
}

float zernike_5(vec3 n) {
  precise float square = n.x * n.x - n.y * n.y;
  precise float value = (square / (1.0 + zernike_height(n))) * 0.977205024;  // sqrt(6/2pi)
  return value;
}

float zernike_6(vec3 n) {
  precise float value = ((n.x * n.y) / (1.0 + zernike_height(n))) * 1.95441005;  // 2 sqrt(6/2pi)
  return value;
}
