// Euclidean length, without scaling: components above 2^63 overflow to infinity, all below 2^-63 give 0.
#include "exact/dot.glsl"

float exact_length(vec2 v) {
  precise float length_of_v = sqrt(exact_dot(v, v));
  return length_of_v;
}

float exact_length(vec3 v) {
  precise float length_of_v = sqrt(exact_dot(v, v));
  return length_of_v;
}

float exact_length(vec4 v) {
  precise float length_of_v = sqrt(exact_dot(v, v));
  return length_of_v;
}
