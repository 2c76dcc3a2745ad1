// Weights of visibility from the vertices, four an attribute: element q of the interpolated array VISIBILITY has weights 4q to
// 4q + 3. Includer defines VISIBILITY, as in visibility_sh, and VISIBILITY_COUNT, the weights read.

in vec4 VISIBILITY[(VISIBILITY_COUNT + 3) / 4];

void load_coefficients() {
}

vec4 visibility_weights(int quad) {
  return VISIBILITY[quad];
}
