// Matrix products: sums in the order of the columns of the left factor.

vec2 exact_multiply(mat2 m, vec2 v) {
  precise vec2 product = m[0] * v.x + m[1] * v.y;
  return product;
}

vec3 exact_multiply(mat3 m, vec3 v) {
  precise vec3 product = (m[0] * v.x + m[1] * v.y) + m[2] * v.z;
  return product;
}

vec4 exact_multiply(mat4 m, vec4 v) {
  precise vec4 product = ((m[0] * v.x + m[1] * v.y) + m[2] * v.z) + m[3] * v.w;
  return product;
}

// v is a row: the transposed matrix times v.
vec2 exact_multiply(vec2 v, mat2 m) {
  precise float x = v.x * m[0].x + v.y * m[0].y;
  precise float y = v.x * m[1].x + v.y * m[1].y;
  return vec2(x, y);
}

vec3 exact_multiply(vec3 v, mat3 m) {
  precise float x = (v.x * m[0].x + v.y * m[0].y) + v.z * m[0].z;
  precise float y = (v.x * m[1].x + v.y * m[1].y) + v.z * m[1].z;
  precise float z = (v.x * m[2].x + v.y * m[2].y) + v.z * m[2].z;
  return vec3(x, y, z);
}

vec4 exact_multiply(vec4 v, mat4 m) {
  precise float x = ((v.x * m[0].x + v.y * m[0].y) + v.z * m[0].z) + v.w * m[0].w;
  precise float y = ((v.x * m[1].x + v.y * m[1].y) + v.z * m[1].z) + v.w * m[1].w;
  precise float z = ((v.x * m[2].x + v.y * m[2].y) + v.z * m[2].z) + v.w * m[2].w;
  precise float w = ((v.x * m[3].x + v.y * m[3].y) + v.z * m[3].z) + v.w * m[3].w;
  return vec4(x, y, z, w);
}

mat2 exact_multiply(mat2 a, mat2 b) {
  return mat2(exact_multiply(a, b[0]), exact_multiply(a, b[1]));
}

mat3 exact_multiply(mat3 a, mat3 b) {
  return mat3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]));
}

mat4 exact_multiply(mat4 a, mat4 b) {
  return mat4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3]));
}
