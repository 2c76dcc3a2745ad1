// The ordinary lightmap: one coefficient, the irradiance at the flat normal (0,0,1), whatever the normal is. A constant basis
// function, but its coefficient is that value, not the least-squares fit over the hemisphere.
// Includer defines COEF(i): coefficient i as vec3.

const int BASIS_COUNT = 1;

float basis_value(int i, vec3 n) {
  return 1.0;
}

vec3 basis_irradiance(vec3 n) {
  return COEF(0);
}
