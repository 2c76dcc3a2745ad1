// The H-basis, orthonormal on the upper hemisphere. Habel and Wimmer, Efficient Irradiance Normal Mapping, I3D 2010, eqs. 8-13,
// in Cartesian form. Signs follow the real spherical harmonics with the factor (-1)^m, so that T_h (eq. 14) has no negative
// entry for l <= 2. Constants are rounded once to float.

float h_1() {
  return 0.398942280;  // 1/sqrt(2pi)
}

float h_2(vec3 n) {
  precise float value = n.y * -0.690988299;  // -sqrt(3/2pi) y
  return value;
}

float h_3(vec3 n) {
  precise float value = n.z * 1.38197660 - 0.690988299;  // sqrt(3/2pi) (2z - 1)
  return value;
}

float h_4(vec3 n) {
  precise float value = n.x * -0.690988299;  // -sqrt(3/2pi) x
  return value;
}

float h_5(vec3 n) {
  precise float value = (n.x * n.y) * 1.54509681;  // sqrt(15/2pi) xy
  return value;
}

float h_6(vec3 n) {
  precise float value = (n.x * n.x - n.y * n.y) * 0.772548404;  // 1/2 sqrt(15/2pi) (x^2 - y^2)
  return value;
}
