// Real spherical harmonics with the factor (-1)^m, orthonormal on the sphere, l <= 2, index l*l + l + m, in Cartesian form.
// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001, eq. 3, signs as said.

float sh_0() {
  return 0.282094792;  // sqrt(1/4pi)
}

float sh_1(vec3 n) {
  precise float value = n.y * -0.488602512;  // -sqrt(3/4pi) y
  return value;
}

float sh_2(vec3 n) {
  precise float value = n.z * 0.488602512;  // sqrt(3/4pi) z
  return value;
}

float sh_3(vec3 n) {
  precise float value = n.x * -0.488602512;  // -sqrt(3/4pi) x
  return value;
}

float sh_4(vec3 n) {
  precise float value = (n.x * n.y) * 1.09254843;  // sqrt(15/4pi) xy
  return value;
}

float sh_5(vec3 n) {
  precise float value = (n.y * n.z) * -1.09254843;  // -sqrt(15/4pi) yz
  return value;
}

float sh_6(vec3 n) {
  precise float value = (n.z * n.z) * 0.946174696 - 0.315391565;  // sqrt(5/16pi) (3 z^2 - 1)
  return value;
}

float sh_7(vec3 n) {
  precise float value = (n.x * n.z) * -1.09254843;  // -sqrt(15/4pi) xz
  return value;
}

float sh_8(vec3 n) {
  precise float value = (n.x * n.x - n.y * n.y) * 0.546274215;  // sqrt(15/16pi) (x^2 - y^2)
  return value;
}
