// Hemispherical harmonics: associated Legendre polynomials shifted to z in [0, 1], orthonormal on the hemisphere, without the
// factor (-1)^m. Gautron, Krivanek, Pattanaik and Bouatouch, A Novel Hemispherical Basis for Accurate and Efficient Rendering,
// EGSR 2004, in Cartesian form with u = z/(1 + z): sin(theta') cos(phi) = 2 x sqrt(u), no square root of a rounding error at
// the horizon and no 0/0 at the pole. Index l*l + l + m, all over sqrt(2pi). Below the horizon z counts as 0, NaN too.

float hsh_height(vec3 n) {
  return n.z > 0.0 ? n.z : 0.0;
}

float hsh_u(vec3 n) {
  float z = hsh_height(n);
  precise float u = z / (1.0 + z);
  return u;
}

float hsh_0() {
  return 0.398942280;  // 1/sqrt(2pi)
}

float hsh_1(vec3 n) {
  precise float value = (n.y * sqrt(hsh_u(n))) * 1.38197660;  // 2 sqrt(3/2pi) y sqrt(u)
  return value;
}

float hsh_2(vec3 n) {
  precise float value = hsh_height(n) * 1.38197660 - 0.690988299;  // sqrt(3/2pi) (2z - 1)
  return value;
}

float hsh_3(vec3 n) {
  precise float value = (n.x * sqrt(hsh_u(n))) * 1.38197660;  // 2 sqrt(3/2pi) x sqrt(u)
  return value;
}

float hsh_4(vec3 n) {
  precise float value = ((n.x * n.y) * hsh_u(n)) * 6.18038723;  // 4 sqrt(15/2pi) uxy
  return value;
}

float hsh_5(vec3 n) {
  // 2 sqrt(15/2pi) (2z - 1) y sqrt(u)
  precise float value = ((hsh_height(n) * 2.0 - 1.0) * (n.y * sqrt(hsh_u(n)))) * 3.09019362;
  return value;
}

float hsh_6(vec3 n) {
  float z = hsh_height(n);
  precise float value = ((z * 6.0 - 6.0) * z + 1.0) * 0.892062058;  // sqrt(5/2pi) (6z^2 - 6z + 1)
  return value;
}

float hsh_7(vec3 n) {
  // 2 sqrt(15/2pi) (2z - 1) x sqrt(u)
  precise float value = ((hsh_height(n) * 2.0 - 1.0) * (n.x * sqrt(hsh_u(n)))) * 3.09019362;
  return value;
}

float hsh_8(vec3 n) {
  precise float square = n.x * n.x - n.y * n.y;
  precise float value = (square * hsh_u(n)) * 3.09019362;  // 2 sqrt(15/2pi) u (x^2 - y^2)
  return value;
}
