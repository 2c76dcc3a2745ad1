// Real spherical harmonics of band 5, as sh_functions.glsl has bands 0 to 2: factor (-1)^m, orthonormal on the sphere, index
// l*l + l + m, in Cartesian form. Sloan, Stupid Spherical Harmonics (SH) Tricks, 2008, appendix A2, signs as said.

float sh_25(vec3 n) {
  precise float x2 = n.x * n.x;
  precise float y2 = n.y * n.y;
  // -sqrt(693/512pi) y (5x^4 - 10x^2 y^2 + y^4)
  precise float value = (((x2 * 5.0 - y2 * 10.0) * x2 + y2 * y2) * n.y) * -0.656382057;
  return value;
}

float sh_26(vec3 n) {
  precise float value = (((n.x * n.y) * n.z) * (n.x * n.x - n.y * n.y)) * 8.30264926;  // sqrt(3465/16pi) xyz (x^2 - y^2)
  return value;
}

float sh_27(vec3 n) {
  // -sqrt(385/512pi) y (3x^2 - y^2)(9z^2 - 1)
  precise float value = ((((n.x * n.x) * 3.0 - n.y * n.y) * n.y) * ((n.z * n.z) * 9.0 - 1.0)) * -0.489238299;
  return value;
}

float sh_28(vec3 n) {
  precise float value = (((n.x * n.y) * n.z) * ((n.z * n.z) * 3.0 - 1.0)) * 4.79353678;  // sqrt(1155/16pi) xyz (3z^2 - 1)
  return value;
}

float sh_29(vec3 n) {
  precise float z2 = n.z * n.z;
  precise float value = (((z2 * 21.0 - 14.0) * z2 + 1.0) * n.y) * -0.452946651;  // -sqrt(165/256pi) y (21z^4 - 14z^2 + 1)
  return value;
}

float sh_30(vec3 n) {
  precise float z2 = n.z * n.z;
  precise float value = (((z2 * 63.0 - 70.0) * z2 + 15.0) * n.z) * 0.116950322;  // sqrt(11/256pi) z (63z^4 - 70z^2 + 15)
  return value;
}

float sh_31(vec3 n) {
  precise float z2 = n.z * n.z;
  precise float value = (((z2 * 21.0 - 14.0) * z2 + 1.0) * n.x) * -0.452946651;  // -sqrt(165/256pi) x (21z^4 - 14z^2 + 1)
  return value;
}

float sh_32(vec3 n) {
  precise float square = n.x * n.x - n.y * n.y;
  // sqrt(1155/64pi) z (x^2 - y^2)(3z^2 - 1)
  precise float value = ((square * n.z) * ((n.z * n.z) * 3.0 - 1.0)) * 2.39676839;
  return value;
}

float sh_33(vec3 n) {
  // -sqrt(385/512pi) x (x^2 - 3y^2)(9z^2 - 1)
  precise float value = (((n.x * n.x - (n.y * n.y) * 3.0) * n.x) * ((n.z * n.z) * 9.0 - 1.0)) * -0.489238299;
  return value;
}

float sh_34(vec3 n) {
  precise float x2 = n.x * n.x;
  precise float y2 = n.y * n.y;
  precise float value = (((x2 - y2 * 6.0) * x2 + y2 * y2) * n.z) * 2.07566231;  // sqrt(3465/256pi) z (x^4 - 6x^2 y^2 + y^4)
  return value;
}

float sh_35(vec3 n) {
  precise float x2 = n.x * n.x;
  precise float y2 = n.y * n.y;
  // -sqrt(693/512pi) x (x^4 - 10x^2 y^2 + 5y^4)
  precise float value = (((x2 - y2 * 10.0) * x2 + (y2 * y2) * 5.0) * n.x) * -0.656382057;
  return value;
}
