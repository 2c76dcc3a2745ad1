// Dot products, summed in the order of the components.

float exact_dot(vec2 a, vec2 b) {
  precise float sum = a.x * b.x + a.y * b.y;
  return sum;
}

float exact_dot(vec3 a, vec3 b) {
  precise float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  return sum;
}

float exact_dot(vec4 a, vec4 b) {
  precise float sum = ((a.x * b.x + a.y * b.y) + a.z * b.z) + a.w * b.w;
  return sum;
}
