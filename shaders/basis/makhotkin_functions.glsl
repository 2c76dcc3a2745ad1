// Makhotkin's functions: (z - z^2)^(|m|/2) P_{l-|m|}^{(|m|,|m|+1)}(2z - 1), Jacobi polynomials, times sin(|m| phi) for m < 0 and
// cos(m phi) for m >= 0; orthogonal on the hemisphere for the weight z, not normalised. Makhotkin, Analysis of radiative transfer
// between surfaces by hemispherical harmonics, JQSRT 1996. They span what hemispherical harmonics of the same order span. Index
// l*l + l + m, in Cartesian form with u = z/(1 + z). Below the horizon z counts as 0, NaN too.

float makhotkin_height(vec3 n) {
  return n.z > 0.0 ? n.z : 0.0;
}

float makhotkin_u(vec3 n) {
  float z = makhotkin_height(n);
  precise float u = z / (1.0 + z);
  return u;
}

float makhotkin_0() {
  return 1.0;
}

float makhotkin_1(vec3 n) {
  precise float value = n.y * sqrt(makhotkin_u(n));
  return value;
}

float makhotkin_2(vec3 n) {
  precise float value = makhotkin_height(n) * 3.0 - 2.0;
  return value;
}

float makhotkin_3(vec3 n) {
  precise float value = n.x * sqrt(makhotkin_u(n));
  return value;
}

float makhotkin_4(vec3 n) {
  precise float value = ((n.x * n.y) * 2.0) * makhotkin_u(n);
  return value;
}

float makhotkin_5(vec3 n) {
  precise float value = (makhotkin_height(n) * 5.0 - 3.0) * makhotkin_1(n);
  return value;
}

float makhotkin_6(vec3 n) {
  float z = makhotkin_height(n);
  precise float value = (z * 10.0 - 12.0) * z + 3.0;
  return value;
}

float makhotkin_7(vec3 n) {
  precise float value = (makhotkin_height(n) * 5.0 - 3.0) * makhotkin_3(n);
  return value;
}

float makhotkin_8(vec3 n) {
  precise float square = n.x * n.x - n.y * n.y;
  precise float value = square * makhotkin_u(n);
  return value;
}
