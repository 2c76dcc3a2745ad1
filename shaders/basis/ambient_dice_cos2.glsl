// Ambient Dice with cosine lobes: cos^2/2 about each vertex of an icosahedron, a partition of unity. Iwanicki and Sloan, Ambient
// Dice, EGSR 2017, section 3.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.

// Even, so that the sign of the cosine only chooses the vertex.
float dice_lobe(float cosine) {
  precise float value = (cosine * cosine) * 0.5;
  return value;
}

#include "basis/ambient_dice_lobe_functions.glsl"
