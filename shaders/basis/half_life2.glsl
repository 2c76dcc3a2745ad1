// Half-Life 2 basis: cosines to three orthonormal directions above the surface, orthonormal on the hemisphere.
//   McTaggart, Half-Life 2 / Valve Source Shading, GDC 2004; scaled as in Habel and Wimmer, Efficient Irradiance Normal
//   Mapping, I3D 2010, eq. 2: sqrt(3 / 2pi) b_i . n with
//   b_0 = (-1/sqrt6, -1/sqrt2, 1/sqrt3), b_1 = (-1/sqrt6, 1/sqrt2, 1/sqrt3), b_2 = (sqrt(2/3), 0, 1/sqrt3).
// Linear in n: light from below the horizon of b_i counts negatively, and a constant comes back as 1.5 z.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal in tangent space.

const int BASIS_COUNT = 3;

float half_life2_0(vec3 n) {
  precise float value = (n.z * 0.398942280 - n.x * 0.282094792) - n.y * 0.488602512;  // 1/sqrt(2pi) 1/sqrt(4pi) sqrt(3/4pi)
  return value;
}

float half_life2_1(vec3 n) {
  precise float value = (n.z * 0.398942280 - n.x * 0.282094792) + n.y * 0.488602512;  // 1/sqrt(2pi) 1/sqrt(4pi) sqrt(3/4pi)
  return value;
}

float half_life2_2(vec3 n) {
  precise float value = n.z * 0.398942280 + n.x * 0.564189584;  // 1/sqrt(2pi) 1/sqrt(pi)
  return value;
}

float basis_value(int i, vec3 n) {
  return i == 0 ? half_life2_0(n) : i == 1 ? half_life2_1(n) : half_life2_2(n);
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = (COEF(0) * half_life2_0(n) + COEF(1) * half_life2_1(n)) + COEF(2) * half_life2_2(n);
  return irradiance;
}
