// Real spherical harmonics of bands 3 and 4, as sh_functions.glsl has bands 0 to 2: factor (-1)^m, orthonormal on the sphere,
// index l*l + l + m, in Cartesian form. Sloan, Stupid Spherical Harmonics (SH) Tricks, 2008, appendix A2, signs as said.

float sh_9(vec3 n) {
  precise float value = (((n.x * n.x) * 3.0 - n.y * n.y) * n.y) * -0.590043590;  // -sqrt(35/32pi) y (3x^2 - y^2)
  return value;
}

float sh_10(vec3 n) {
  precise float value = ((n.x * n.y) * n.z) * 2.89061144;  // sqrt(105/4pi) xyz
  return value;
}

float sh_11(vec3 n) {
  precise float value = (((n.z * n.z) * 5.0 - 1.0) * n.y) * -0.457045799;  // -sqrt(21/32pi) y (5z^2 - 1)
  return value;
}

float sh_12(vec3 n) {
  precise float value = (((n.z * n.z) * 5.0 - 3.0) * n.z) * 0.373176333;  // sqrt(7/16pi) z (5z^2 - 3)
  return value;
}

float sh_13(vec3 n) {
  precise float value = (((n.z * n.z) * 5.0 - 1.0) * n.x) * -0.457045799;  // -sqrt(21/32pi) x (5z^2 - 1)
  return value;
}

float sh_14(vec3 n) {
  precise float value = ((n.x * n.x - n.y * n.y) * n.z) * 1.44530572;  // sqrt(105/16pi) z (x^2 - y^2)
  return value;
}

float sh_15(vec3 n) {
  precise float value = ((n.x * n.x - (n.y * n.y) * 3.0) * n.x) * -0.590043590;  // -sqrt(35/32pi) x (x^2 - 3y^2)
  return value;
}

float sh_16(vec3 n) {
  precise float value = ((n.x * n.y) * (n.x * n.x - n.y * n.y)) * 2.50334294;  // sqrt(315/16pi) xy (x^2 - y^2)
  return value;
}

float sh_17(vec3 n) {
  precise float value = ((n.y * n.z) * ((n.x * n.x) * 3.0 - n.y * n.y)) * -1.77013077;  // -sqrt(315/32pi) yz (3x^2 - y^2)
  return value;
}

float sh_18(vec3 n) {
  precise float value = ((n.x * n.y) * ((n.z * n.z) * 7.0 - 1.0)) * 0.946174696;  // sqrt(45/16pi) xy (7z^2 - 1)
  return value;
}

float sh_19(vec3 n) {
  precise float value = ((n.y * n.z) * ((n.z * n.z) * 7.0 - 3.0)) * -0.669046544;  // -sqrt(45/32pi) yz (7z^2 - 3)
  return value;
}

float sh_20(vec3 n) {
  // sqrt(9/256pi) (35z^4 - 30z^2 + 3)
  precise float value = (((n.z * n.z) * 35.0 - 30.0) * (n.z * n.z) + 3.0) * 0.105785547;
  return value;
}

float sh_21(vec3 n) {
  precise float value = ((n.x * n.z) * ((n.z * n.z) * 7.0 - 3.0)) * -0.669046544;  // -sqrt(45/32pi) xz (7z^2 - 3)
  return value;
}

float sh_22(vec3 n) {
  // sqrt(45/64pi) (x^2 - y^2)(7z^2 - 1)
  precise float value = ((n.x * n.x - n.y * n.y) * ((n.z * n.z) * 7.0 - 1.0)) * 0.473087348;
  return value;
}

float sh_23(vec3 n) {
  precise float value = ((n.x * n.z) * (n.x * n.x - (n.y * n.y) * 3.0)) * -1.77013077;  // -sqrt(315/32pi) xz (x^2 - 3y^2)
  return value;
}

float sh_24(vec3 n) {
  // sqrt(315/256pi) (x^4 - 6x^2 y^2 + y^4)
  precise float value = ((n.x * n.x) * (n.x * n.x - (n.y * n.y) * 6.0) + (n.y * n.y) * (n.y * n.y)) * 0.625835735;
  return value;
}
