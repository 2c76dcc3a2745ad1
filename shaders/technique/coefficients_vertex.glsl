// Coefficients from the vertices: COEF(i) is element i of the interpolated array COEFFICIENTS.
// Includer defines COEFFICIENTS, as in coefficients_h4, and COEFFICIENT_COUNT, the basis' BASIS_COUNT.

in vec3 COEFFICIENTS[COEFFICIENT_COUNT];

void load_coefficients() {
}

#define COEF(i) COEFFICIENTS[i]
