// Ambient Dice with hybrid cubic Bezier patches, spherical or flat: the weights of the coefficients. Iwanicki and Sloan,
// Ambient Dice, EGSR 2017, section 4; spherical patches after Alfeld, Neamtu and Schumaker, Bernstein-Bezier polynomials on
// spheres, 1996. Errata: the paper's alpha and beta are those of unit-sphere gradients over R; its c111^2 repeats terms.
//
// Each vertex has three coefficients: its value and its gradient along e1 and e2 (ambient_dice_functions.glsl), per radian.
// A patch over the triangle of vertices 0, 1, 2 with barycentric coordinates b:
//   sum of c_k b_k^3 + 3 c_kl b_k^2 b_l + 6 b_0 b_1 b_2 (sum of w_k c111^k)
//   c_k = value of vertex k
//   c_kl, next to vertex k towards l, makes the gradient along the edge its own. Unit tangent at v_k towards v_l:
//     alpha v_l + beta v_k, alpha = sqrt5/2, beta = -1/2. Spherical (extended to space as a homogeneous cubic):
//     c_kl = c_k/sqrt5 + 1/3 g_k . v_l. Flat: c_kl = c_k + (edge length)/3 g_k . (alpha v_l + beta v_k)
//   c111^k = a0 (c_l + c_m) + a1 (c_lm + c_ml) + a2 (c_lk + c_mk), for C1 across the edge l m
//   w_k = b_l b_m / (b_0 b_1 + b_1 b_2 + b_2 b_0)
// w is 0/0 at the vertices: 6 b_0 b_1 b_2 w_k tends to 0 there.
#include "basis/ambient_dice_functions.glsl"

// Coefficients k, k + 1 and k + 2 as columns of a matrix, for i.x, i.y and i.z, at once: an includer who can do better than nine
// reads defines it.
#ifndef COEF_THREES
#define COEF_3(k) mat3(COEF(k), COEF((k) + 1), COEF((k) + 2))
#define COEF_THREES(i, threes) threes[0] = COEF_3(i.x); threes[1] = COEF_3(i.y); threes[2] = COEF_3(i.z)
#endif

struct DicePatch {
  vec3 edge;          // a0, a1, a2
  float value_scale;  // of c_k in c_kl
  float slope_scale;  // of g_k . v_l in c_kl
};

struct DiceWeights {
  ivec3 vertex;
  vec3 first, second, third;  // weights of value, d/de1, d/de2 of vertex.x, .y, .z
};

// Weights of the coefficients of vertex i. b: barycentric coordinates of i and the two others; centre: 6 b_0 b_1 b_2 w of the
// same three.
vec3 dice_vertex_weights(int i, vec3 next, vec3 last, vec3 b, vec3 centre, DicePatch patch_kind) {
  precise float square = b.x * b.x;
  precise float three_squares = square * 3.0;
  precise float to_next = (three_squares * b.y + patch_kind.edge.y * centre.z) + patch_kind.edge.z * centre.y;
  precise float to_last = (three_squares * b.z + patch_kind.edge.y * centre.y) + patch_kind.edge.z * centre.z;
  precise float value = (square * b.x + patch_kind.edge.x * (centre.y + centre.z)) +
                        patch_kind.value_scale * (to_next + to_last);
  precise vec3 slope = (next * to_next + last * to_last) * patch_kind.slope_scale;
  return vec3(value, dice_tangent(i, slope));
}

// The triangle's barycentric coordinates as the patch takes them: spherical ones, or flat ones, of sum 1.
DiceWeights dice_weights(DiceTriangle triangle, DicePatch patch_kind) {
  vec3 b = triangle.barycentric;
  precise vec3 edges = b.yzx * b.zxy;  // b_l b_m of the edge opposite each vertex
  precise float edge_sum = (edges.x + edges.y) + edges.z;
  precise float product = (edges.x * b.x) * 6.0;
  precise float share = product / edge_sum;
  share = edge_sum > 0.0 ? share : 0.0;
  precise vec3 centre = edges * share;

  vec3 v0 = dice_vertex(triangle.vertex.x);
  vec3 v1 = dice_vertex(triangle.vertex.y);
  vec3 v2 = dice_vertex(triangle.vertex.z);
  DiceWeights weights;
  weights.vertex = triangle.vertex;
  weights.first = dice_vertex_weights(triangle.vertex.x, v1, v2, b, centre, patch_kind);
  weights.second = dice_vertex_weights(triangle.vertex.y, v2, v0, b.yzx, centre.yzx, patch_kind);
  weights.third = dice_vertex_weights(triangle.vertex.z, v0, v1, b.zxy, centre.zxy, patch_kind);
  return weights;
}

DiceWeights dice_spherical_weights(DiceTriangle triangle) {
  DicePatch patch_kind;
  patch_kind.edge = vec3(-0.0690983006, 0.239918694, 0.223606798);  // (sqrt5 - 5)/40, (11 sqrt5 - 15)/40, sqrt5/10
  patch_kind.value_scale = 0.447213595;                             // 1/sqrt5
  patch_kind.slope_scale = 0.333333333;                             // 1/3
  return dice_weights(triangle, patch_kind);
}

DiceWeights dice_flat_weights(DiceTriangle triangle) {
  DicePatch patch_kind;
  patch_kind.edge = vec3(-0.25, 0.25, 0.5);
  patch_kind.value_scale = 1.0;
  patch_kind.slope_scale = 0.391856835;  // (2/R)/3 sqrt5/2
  vec3 b = triangle.barycentric;
  precise float sum = (b.x + b.y) + b.z;
  precise float scale = 1.0 / sum;
  scale = sum > 0.0 ? scale : 0.0;
  precise vec3 flat_coordinates = b * scale;
  triangle.barycentric = flat_coordinates;
  return dice_weights(triangle, patch_kind);
}

// Weight of coefficient i, numbered 3 vertex + {value, d/de1, d/de2}.
float dice_weight(DiceWeights weights, int i) {
  int vertex = i / 3;
  int which = i - 3 * vertex;
  vec3 w = vertex == weights.vertex.x   ? weights.first
           : vertex == weights.vertex.y ? weights.second
           : vertex == weights.vertex.z ? weights.third
                                        : vec3(0.0);
  return which == 0 ? w.x : which == 1 ? w.y : w.z;
}

// Irradiance from the three vertices' coefficients, numbered so.
vec3 dice_irradiance(DiceWeights weights) {
  ivec3 base = weights.vertex * 3;
  mat3 vertices[3];
  COEF_THREES(base, vertices);
  precise vec3 irradiance = vertices[0][0] * weights.first.x;
  irradiance += vertices[0][1] * weights.first.y;
  irradiance += vertices[0][2] * weights.first.z;
  irradiance += vertices[1][0] * weights.second.x;
  irradiance += vertices[1][1] * weights.second.y;
  irradiance += vertices[1][2] * weights.second.z;
  irradiance += vertices[2][0] * weights.third.x;
  irradiance += vertices[2][1] * weights.third.y;
  irradiance += vertices[2][2] * weights.third.z;
  return irradiance;
}
