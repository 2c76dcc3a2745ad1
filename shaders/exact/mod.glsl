// GLSL's mod, x - y floor(x / y): has the sign of y. Not the remainder of fmod: for large quotients the rounded product
// decides, and the result may be y itself or lie outside [0, y). NaN for y = 0.

float exact_mod(float x, float y) {
  precise float quotient = x / y;
  precise float remainder = x - y * floor(quotient);
  return remainder;
}

vec2 exact_mod(vec2 x, float y) {
  precise vec2 quotient = x / y;
  precise vec2 remainder = x - y * floor(quotient);
  return remainder;
}

vec3 exact_mod(vec3 x, float y) {
  precise vec3 quotient = x / y;
  precise vec3 remainder = x - y * floor(quotient);
  return remainder;
}

vec4 exact_mod(vec4 x, float y) {
  precise vec4 quotient = x / y;
  precise vec4 remainder = x - y * floor(quotient);
  return remainder;
}

vec2 exact_mod(vec2 x, vec2 y) {
  precise vec2 quotient = x / y;
  precise vec2 remainder = x - y * floor(quotient);
  return remainder;
}

vec3 exact_mod(vec3 x, vec3 y) {
  precise vec3 quotient = x / y;
  precise vec3 remainder = x - y * floor(quotient);
  return remainder;
}

vec4 exact_mod(vec4 x, vec4 y) {
  precise vec4 quotient = x / y;
  precise vec4 remainder = x - y * floor(quotient);
  return remainder;
}
