// Ambient Dice with cosine lobes: .7 cos^2 + .3 cos^4 about each vertex of an icosahedron, as the paper's tables have it; not a
// partition of unity. Iwanicki and Sloan, Ambient Dice, EGSR 2017, section 3 and table 1.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.

// Even, so that the sign of the cosine only chooses the vertex.
float dice_lobe(float cosine) {
  precise float square = cosine * cosine;
  precise float value = square * (square * 0.300000000 + 0.700000000);  // .3, .7
  return value;
}

#include "basis/ambient_dice_lobe_functions.glsl"
