// v times the reciprocal of its length: one division. The zero vector gives NaN, as 0 times infinity does.
#include "exact/length.glsl"

vec2 exact_normalize(vec2 v) {
  precise float scale = 1.0 / exact_length(v);
  precise vec2 unit = v * scale;
  return unit;
}

vec3 exact_normalize(vec3 v) {
  precise float scale = 1.0 / exact_length(v);
  precise vec3 unit = v * scale;
  return unit;
}

vec4 exact_normalize(vec4 v) {
  precise float scale = 1.0 / exact_length(v);
  precise vec4 unit = v * scale;
  return unit;
}
