// Attributes and depth of a triangle at a pixel, from clip-space vertices: homogeneous edge functions (Olano and Greer,
// Triangle scan conversion using 2D homogeneous coordinates, 1997), with the origin moved to the pixel first so that small
// triangles keep their digits. No special case for vertices at w <= 0.
//
// p0, p1, p2: clip-space vertices as gl_Position gets them. ndc: the pixel centre in normalised device coordinates of the
// power-of-two viewport, gl_FragCoord.xy * (2 / viewport) - 1, which is exact.

struct ExactBarycentrics {
  vec3 weight;       // perspective-correct, sum 1 up to rounding; attribute = (a0 * weight.x + a1 * weight.y) + a2 * weight.z
  float depth;       // window depth, clamped to [0, 1]; 0 where undefined
  float reciprocal_w;  // 1 / w at the pixel: gl_FragCoord.w
  bool front_facing;   // counter-clockwise in a y-up window
};

ExactBarycentrics exact_barycentrics(vec4 p0, vec4 p1, vec4 p2, vec2 ndc) {
  precise float x0 = p0.x - ndc.x * p0.w;
  precise float y0 = p0.y - ndc.y * p0.w;
  precise float x1 = p1.x - ndc.x * p1.w;
  precise float y1 = p1.y - ndc.y * p1.w;
  precise float x2 = p2.x - ndc.x * p2.w;
  precise float y2 = p2.y - ndc.y * p2.w;
  precise float e0 = x1 * y2 - x2 * y1;
  precise float e1 = x2 * y0 - x0 * y2;
  precise float e2 = x0 * y1 - x1 * y0;
  precise float sum = (e0 + e1) + e2;
  precise float r = 1.0 / sum;
  precise float z = (e0 * p0.z + e1 * p1.z) + e2 * p2.z;
  precise float w = (e0 * p0.w + e1 * p1.w) + e2 * p2.w;
  precise float depth = (z / w) * 0.5 + 0.5;
  precise float reciprocal_w = sum / w;
  ExactBarycentrics result;
  precise float weight0 = e0 * r;
  precise float weight1 = e1 * r;
  precise float weight2 = e2 * r;
  result.weight = vec3(weight0, weight1, weight2);
  result.depth = depth > 0.0 ? (depth < 1.0 ? depth : 1.0) : 0.0;
  result.reciprocal_w = reciprocal_w;
  result.front_facing = w > 0.0;
  return result;
}

float exact_interpolate(float a0, float a1, float a2, vec3 weight) {
  precise float value = (a0 * weight.x + a1 * weight.y) + a2 * weight.z;
  return value;
}
