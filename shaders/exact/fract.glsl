// x - floor(x). In [0, 1]: a negative x closer to zero than 2^-25 gives 1. NaN where x is infinite.

float exact_fract(float x) {
  precise float fraction = x - floor(x);
  return fraction;
}

vec2 exact_fract(vec2 x) {
  precise vec2 fraction = x - floor(x);
  return fraction;
}

vec3 exact_fract(vec3 x) {
  precise vec3 fraction = x - floor(x);
  return fraction;
}

vec4 exact_fract(vec4 x) {
  precise vec4 fraction = x - floor(x);
  return fraction;
}
