// Ambient Dice with cosine lobes: .7 (cos^2/2) + .3 (5/6 cos^4) about each vertex of an icosahedron, a partition of unity.
// Iwanicki and Sloan, Ambient Dice, EGSR 2017, section 3.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.

// Even, so that the sign of the cosine only chooses the vertex.
float dice_lobe(float cosine) {
  precise float square = cosine * cosine;
  precise float value = square * (square * 0.25 + 0.350000000);  // .3 5/6, .7/2
  return value;
}

#include "basis/ambient_dice_lobe_functions.glsl"
