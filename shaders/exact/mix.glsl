// Linear interpolation a (1 - t) + b t: exactly a at t = 0 and exactly b at t = 1, for finite a and b.

float exact_mix(float a, float b, float t) {
  precise float mixed = a * (1.0 - t) + b * t;
  return mixed;
}

vec2 exact_mix(vec2 a, vec2 b, float t) {
  precise float s = 1.0 - t;
  precise vec2 mixed = a * s + b * t;
  return mixed;
}

vec3 exact_mix(vec3 a, vec3 b, float t) {
  precise float s = 1.0 - t;
  precise vec3 mixed = a * s + b * t;
  return mixed;
}

vec4 exact_mix(vec4 a, vec4 b, float t) {
  precise float s = 1.0 - t;
  precise vec4 mixed = a * s + b * t;
  return mixed;
}

vec2 exact_mix(vec2 a, vec2 b, vec2 t) {
  precise vec2 mixed = a * (1.0 - t) + b * t;
  return mixed;
}

vec3 exact_mix(vec3 a, vec3 b, vec3 t) {
  precise vec3 mixed = a * (1.0 - t) + b * t;
  return mixed;
}

vec4 exact_mix(vec4 a, vec4 b, vec4 t) {
  precise vec4 mixed = a * (1.0 - t) + b * t;
  return mixed;
}
