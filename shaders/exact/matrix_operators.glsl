// What matrix.glsl leaves out: products of other shapes, operations by component, outer products, determinants and inverses.
// Products sum in the order of the columns of the left factor.
#include "exact/dot.glsl"
#include "exact/matrix.glsl"
#include "exact/operators.glsl"

// mat * column and row * mat
vec3 exact_multiply(mat2x3 m, vec2 v) { precise vec3 product = m[0] * v.x + m[1] * v.y; return product; }
vec4 exact_multiply(mat2x4 m, vec2 v) { precise vec4 product = m[0] * v.x + m[1] * v.y; return product; }
vec2 exact_multiply(mat3x2 m, vec3 v) { precise vec2 product = (m[0] * v.x + m[1] * v.y) + m[2] * v.z; return product; }
vec4 exact_multiply(mat3x4 m, vec3 v) { precise vec4 product = (m[0] * v.x + m[1] * v.y) + m[2] * v.z; return product; }
vec2 exact_multiply(mat4x2 m, vec4 v) { precise vec2 product = ((m[0] * v.x + m[1] * v.y) + m[2] * v.z) + m[3] * v.w; return product; }
vec3 exact_multiply(mat4x3 m, vec4 v) { precise vec3 product = ((m[0] * v.x + m[1] * v.y) + m[2] * v.z) + m[3] * v.w; return product; }
vec2 exact_multiply(vec3 v, mat2x3 m) { return vec2(exact_dot(v, m[0]), exact_dot(v, m[1])); }
vec2 exact_multiply(vec4 v, mat2x4 m) { return vec2(exact_dot(v, m[0]), exact_dot(v, m[1])); }
vec3 exact_multiply(vec2 v, mat3x2 m) { return vec3(exact_dot(v, m[0]), exact_dot(v, m[1]), exact_dot(v, m[2])); }
vec3 exact_multiply(vec4 v, mat3x4 m) { return vec3(exact_dot(v, m[0]), exact_dot(v, m[1]), exact_dot(v, m[2])); }
vec4 exact_multiply(vec2 v, mat4x2 m) { return vec4(exact_dot(v, m[0]), exact_dot(v, m[1]), exact_dot(v, m[2]), exact_dot(v, m[3])); }
vec4 exact_multiply(vec3 v, mat4x3 m) { return vec4(exact_dot(v, m[0]), exact_dot(v, m[1]), exact_dot(v, m[2]), exact_dot(v, m[3])); }

// mat * mat
mat3x2 exact_multiply(mat2 a, mat3x2 b) { return mat3x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4x2 exact_multiply(mat2 a, mat4x2 b) { return mat4x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2x3 exact_multiply(mat2x3 a, mat2 b) { return mat2x3(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3 exact_multiply(mat2x3 a, mat3x2 b) { return mat3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4x3 exact_multiply(mat2x3 a, mat4x2 b) { return mat4x3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2x4 exact_multiply(mat2x4 a, mat2 b) { return mat2x4(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3x4 exact_multiply(mat2x4 a, mat3x2 b) { return mat3x4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4 exact_multiply(mat2x4 a, mat4x2 b) { return mat4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2 exact_multiply(mat3x2 a, mat2x3 b) { return mat2(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3x2 exact_multiply(mat3x2 a, mat3 b) { return mat3x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4x2 exact_multiply(mat3x2 a, mat4x3 b) { return mat4x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2x3 exact_multiply(mat3 a, mat2x3 b) { return mat2x3(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat4x3 exact_multiply(mat3 a, mat4x3 b) { return mat4x3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2x4 exact_multiply(mat3x4 a, mat2x3 b) { return mat2x4(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3x4 exact_multiply(mat3x4 a, mat3 b) { return mat3x4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4 exact_multiply(mat3x4 a, mat4x3 b) { return mat4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2 exact_multiply(mat4x2 a, mat2x4 b) { return mat2(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3x2 exact_multiply(mat4x2 a, mat3x4 b) { return mat3x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4x2 exact_multiply(mat4x2 a, mat4 b) { return mat4x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2x3 exact_multiply(mat4x3 a, mat2x4 b) { return mat2x3(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3 exact_multiply(mat4x3 a, mat3x4 b) { return mat3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4x3 exact_multiply(mat4x3 a, mat4 b) { return mat4x3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2x4 exact_multiply(mat4 a, mat2x4 b) { return mat2x4(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3x4 exact_multiply(mat4 a, mat3x4 b) { return mat3x4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }

// by component
mat2 exact_add(mat2 a, mat2 b) { return mat2(exact_add(a[0], b[0]), exact_add(a[1], b[1])); }
mat2x3 exact_add(mat2x3 a, mat2x3 b) { return mat2x3(exact_add(a[0], b[0]), exact_add(a[1], b[1])); }
mat2x4 exact_add(mat2x4 a, mat2x4 b) { return mat2x4(exact_add(a[0], b[0]), exact_add(a[1], b[1])); }
mat3x2 exact_add(mat3x2 a, mat3x2 b) { return mat3x2(exact_add(a[0], b[0]), exact_add(a[1], b[1]), exact_add(a[2], b[2])); }
mat3 exact_add(mat3 a, mat3 b) { return mat3(exact_add(a[0], b[0]), exact_add(a[1], b[1]), exact_add(a[2], b[2])); }
mat3x4 exact_add(mat3x4 a, mat3x4 b) { return mat3x4(exact_add(a[0], b[0]), exact_add(a[1], b[1]), exact_add(a[2], b[2])); }
mat4x2 exact_add(mat4x2 a, mat4x2 b) { return mat4x2(exact_add(a[0], b[0]), exact_add(a[1], b[1]), exact_add(a[2], b[2]), exact_add(a[3], b[3])); }
mat4x3 exact_add(mat4x3 a, mat4x3 b) { return mat4x3(exact_add(a[0], b[0]), exact_add(a[1], b[1]), exact_add(a[2], b[2]), exact_add(a[3], b[3])); }
mat4 exact_add(mat4 a, mat4 b) { return mat4(exact_add(a[0], b[0]), exact_add(a[1], b[1]), exact_add(a[2], b[2]), exact_add(a[3], b[3])); }
mat2 exact_subtract(mat2 a, mat2 b) { return mat2(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1])); }
mat2x3 exact_subtract(mat2x3 a, mat2x3 b) { return mat2x3(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1])); }
mat2x4 exact_subtract(mat2x4 a, mat2x4 b) { return mat2x4(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1])); }
mat3x2 exact_subtract(mat3x2 a, mat3x2 b) { return mat3x2(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1]), exact_subtract(a[2], b[2])); }
mat3 exact_subtract(mat3 a, mat3 b) { return mat3(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1]), exact_subtract(a[2], b[2])); }
mat3x4 exact_subtract(mat3x4 a, mat3x4 b) { return mat3x4(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1]), exact_subtract(a[2], b[2])); }
mat4x2 exact_subtract(mat4x2 a, mat4x2 b) { return mat4x2(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1]), exact_subtract(a[2], b[2]), exact_subtract(a[3], b[3])); }
mat4x3 exact_subtract(mat4x3 a, mat4x3 b) { return mat4x3(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1]), exact_subtract(a[2], b[2]), exact_subtract(a[3], b[3])); }
mat4 exact_subtract(mat4 a, mat4 b) { return mat4(exact_subtract(a[0], b[0]), exact_subtract(a[1], b[1]), exact_subtract(a[2], b[2]), exact_subtract(a[3], b[3])); }
mat2 exact_divide(mat2 a, mat2 b) { return mat2(exact_divide(a[0], b[0]), exact_divide(a[1], b[1])); }
mat2x3 exact_divide(mat2x3 a, mat2x3 b) { return mat2x3(exact_divide(a[0], b[0]), exact_divide(a[1], b[1])); }
mat2x4 exact_divide(mat2x4 a, mat2x4 b) { return mat2x4(exact_divide(a[0], b[0]), exact_divide(a[1], b[1])); }
mat3x2 exact_divide(mat3x2 a, mat3x2 b) { return mat3x2(exact_divide(a[0], b[0]), exact_divide(a[1], b[1]), exact_divide(a[2], b[2])); }
mat3 exact_divide(mat3 a, mat3 b) { return mat3(exact_divide(a[0], b[0]), exact_divide(a[1], b[1]), exact_divide(a[2], b[2])); }
mat3x4 exact_divide(mat3x4 a, mat3x4 b) { return mat3x4(exact_divide(a[0], b[0]), exact_divide(a[1], b[1]), exact_divide(a[2], b[2])); }
mat4x2 exact_divide(mat4x2 a, mat4x2 b) { return mat4x2(exact_divide(a[0], b[0]), exact_divide(a[1], b[1]), exact_divide(a[2], b[2]), exact_divide(a[3], b[3])); }
mat4x3 exact_divide(mat4x3 a, mat4x3 b) { return mat4x3(exact_divide(a[0], b[0]), exact_divide(a[1], b[1]), exact_divide(a[2], b[2]), exact_divide(a[3], b[3])); }
mat4 exact_divide(mat4 a, mat4 b) { return mat4(exact_divide(a[0], b[0]), exact_divide(a[1], b[1]), exact_divide(a[2], b[2]), exact_divide(a[3], b[3])); }
mat2 exact_add(mat2 a, float b) { return mat2(exact_add(a[0], b), exact_add(a[1], b)); }
mat2 exact_add(float a, mat2 b) { return mat2(exact_add(a, b[0]), exact_add(a, b[1])); }
mat2x3 exact_add(mat2x3 a, float b) { return mat2x3(exact_add(a[0], b), exact_add(a[1], b)); }
mat2x3 exact_add(float a, mat2x3 b) { return mat2x3(exact_add(a, b[0]), exact_add(a, b[1])); }
mat2x4 exact_add(mat2x4 a, float b) { return mat2x4(exact_add(a[0], b), exact_add(a[1], b)); }
mat2x4 exact_add(float a, mat2x4 b) { return mat2x4(exact_add(a, b[0]), exact_add(a, b[1])); }
mat3x2 exact_add(mat3x2 a, float b) { return mat3x2(exact_add(a[0], b), exact_add(a[1], b), exact_add(a[2], b)); }
mat3x2 exact_add(float a, mat3x2 b) { return mat3x2(exact_add(a, b[0]), exact_add(a, b[1]), exact_add(a, b[2])); }
mat3 exact_add(mat3 a, float b) { return mat3(exact_add(a[0], b), exact_add(a[1], b), exact_add(a[2], b)); }
mat3 exact_add(float a, mat3 b) { return mat3(exact_add(a, b[0]), exact_add(a, b[1]), exact_add(a, b[2])); }
mat3x4 exact_add(mat3x4 a, float b) { return mat3x4(exact_add(a[0], b), exact_add(a[1], b), exact_add(a[2], b)); }
mat3x4 exact_add(float a, mat3x4 b) { return mat3x4(exact_add(a, b[0]), exact_add(a, b[1]), exact_add(a, b[2])); }
mat4x2 exact_add(mat4x2 a, float b) { return mat4x2(exact_add(a[0], b), exact_add(a[1], b), exact_add(a[2], b), exact_add(a[3], b)); }
mat4x2 exact_add(float a, mat4x2 b) { return mat4x2(exact_add(a, b[0]), exact_add(a, b[1]), exact_add(a, b[2]), exact_add(a, b[3])); }
mat4x3 exact_add(mat4x3 a, float b) { return mat4x3(exact_add(a[0], b), exact_add(a[1], b), exact_add(a[2], b), exact_add(a[3], b)); }
mat4x3 exact_add(float a, mat4x3 b) { return mat4x3(exact_add(a, b[0]), exact_add(a, b[1]), exact_add(a, b[2]), exact_add(a, b[3])); }
mat4 exact_add(mat4 a, float b) { return mat4(exact_add(a[0], b), exact_add(a[1], b), exact_add(a[2], b), exact_add(a[3], b)); }
mat4 exact_add(float a, mat4 b) { return mat4(exact_add(a, b[0]), exact_add(a, b[1]), exact_add(a, b[2]), exact_add(a, b[3])); }
mat2 exact_subtract(mat2 a, float b) { return mat2(exact_subtract(a[0], b), exact_subtract(a[1], b)); }
mat2 exact_subtract(float a, mat2 b) { return mat2(exact_subtract(a, b[0]), exact_subtract(a, b[1])); }
mat2x3 exact_subtract(mat2x3 a, float b) { return mat2x3(exact_subtract(a[0], b), exact_subtract(a[1], b)); }
mat2x3 exact_subtract(float a, mat2x3 b) { return mat2x3(exact_subtract(a, b[0]), exact_subtract(a, b[1])); }
mat2x4 exact_subtract(mat2x4 a, float b) { return mat2x4(exact_subtract(a[0], b), exact_subtract(a[1], b)); }
mat2x4 exact_subtract(float a, mat2x4 b) { return mat2x4(exact_subtract(a, b[0]), exact_subtract(a, b[1])); }
mat3x2 exact_subtract(mat3x2 a, float b) { return mat3x2(exact_subtract(a[0], b), exact_subtract(a[1], b), exact_subtract(a[2], b)); }
mat3x2 exact_subtract(float a, mat3x2 b) { return mat3x2(exact_subtract(a, b[0]), exact_subtract(a, b[1]), exact_subtract(a, b[2])); }
mat3 exact_subtract(mat3 a, float b) { return mat3(exact_subtract(a[0], b), exact_subtract(a[1], b), exact_subtract(a[2], b)); }
mat3 exact_subtract(float a, mat3 b) { return mat3(exact_subtract(a, b[0]), exact_subtract(a, b[1]), exact_subtract(a, b[2])); }
mat3x4 exact_subtract(mat3x4 a, float b) { return mat3x4(exact_subtract(a[0], b), exact_subtract(a[1], b), exact_subtract(a[2], b)); }
mat3x4 exact_subtract(float a, mat3x4 b) { return mat3x4(exact_subtract(a, b[0]), exact_subtract(a, b[1]), exact_subtract(a, b[2])); }
mat4x2 exact_subtract(mat4x2 a, float b) { return mat4x2(exact_subtract(a[0], b), exact_subtract(a[1], b), exact_subtract(a[2], b), exact_subtract(a[3], b)); }
mat4x2 exact_subtract(float a, mat4x2 b) { return mat4x2(exact_subtract(a, b[0]), exact_subtract(a, b[1]), exact_subtract(a, b[2]), exact_subtract(a, b[3])); }
mat4x3 exact_subtract(mat4x3 a, float b) { return mat4x3(exact_subtract(a[0], b), exact_subtract(a[1], b), exact_subtract(a[2], b), exact_subtract(a[3], b)); }
mat4x3 exact_subtract(float a, mat4x3 b) { return mat4x3(exact_subtract(a, b[0]), exact_subtract(a, b[1]), exact_subtract(a, b[2]), exact_subtract(a, b[3])); }
mat4 exact_subtract(mat4 a, float b) { return mat4(exact_subtract(a[0], b), exact_subtract(a[1], b), exact_subtract(a[2], b), exact_subtract(a[3], b)); }
mat4 exact_subtract(float a, mat4 b) { return mat4(exact_subtract(a, b[0]), exact_subtract(a, b[1]), exact_subtract(a, b[2]), exact_subtract(a, b[3])); }
mat2 exact_multiply(mat2 a, float b) { return mat2(exact_multiply(a[0], b), exact_multiply(a[1], b)); }
mat2 exact_multiply(float a, mat2 b) { return mat2(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat2x3 exact_multiply(mat2x3 a, float b) { return mat2x3(exact_multiply(a[0], b), exact_multiply(a[1], b)); }
mat2x3 exact_multiply(float a, mat2x3 b) { return mat2x3(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat2x4 exact_multiply(mat2x4 a, float b) { return mat2x4(exact_multiply(a[0], b), exact_multiply(a[1], b)); }
mat2x4 exact_multiply(float a, mat2x4 b) { return mat2x4(exact_multiply(a, b[0]), exact_multiply(a, b[1])); }
mat3x2 exact_multiply(mat3x2 a, float b) { return mat3x2(exact_multiply(a[0], b), exact_multiply(a[1], b), exact_multiply(a[2], b)); }
mat3x2 exact_multiply(float a, mat3x2 b) { return mat3x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat3 exact_multiply(mat3 a, float b) { return mat3(exact_multiply(a[0], b), exact_multiply(a[1], b), exact_multiply(a[2], b)); }
mat3 exact_multiply(float a, mat3 b) { return mat3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat3x4 exact_multiply(mat3x4 a, float b) { return mat3x4(exact_multiply(a[0], b), exact_multiply(a[1], b), exact_multiply(a[2], b)); }
mat3x4 exact_multiply(float a, mat3x4 b) { return mat3x4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2])); }
mat4x2 exact_multiply(mat4x2 a, float b) { return mat4x2(exact_multiply(a[0], b), exact_multiply(a[1], b), exact_multiply(a[2], b), exact_multiply(a[3], b)); }
mat4x2 exact_multiply(float a, mat4x2 b) { return mat4x2(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat4x3 exact_multiply(mat4x3 a, float b) { return mat4x3(exact_multiply(a[0], b), exact_multiply(a[1], b), exact_multiply(a[2], b), exact_multiply(a[3], b)); }
mat4x3 exact_multiply(float a, mat4x3 b) { return mat4x3(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat4 exact_multiply(mat4 a, float b) { return mat4(exact_multiply(a[0], b), exact_multiply(a[1], b), exact_multiply(a[2], b), exact_multiply(a[3], b)); }
mat4 exact_multiply(float a, mat4 b) { return mat4(exact_multiply(a, b[0]), exact_multiply(a, b[1]), exact_multiply(a, b[2]), exact_multiply(a, b[3])); }
mat2 exact_divide(mat2 a, float b) { return mat2(exact_divide(a[0], b), exact_divide(a[1], b)); }
mat2 exact_divide(float a, mat2 b) { return mat2(exact_divide(a, b[0]), exact_divide(a, b[1])); }
mat2x3 exact_divide(mat2x3 a, float b) { return mat2x3(exact_divide(a[0], b), exact_divide(a[1], b)); }
mat2x3 exact_divide(float a, mat2x3 b) { return mat2x3(exact_divide(a, b[0]), exact_divide(a, b[1])); }
mat2x4 exact_divide(mat2x4 a, float b) { return mat2x4(exact_divide(a[0], b), exact_divide(a[1], b)); }
mat2x4 exact_divide(float a, mat2x4 b) { return mat2x4(exact_divide(a, b[0]), exact_divide(a, b[1])); }
mat3x2 exact_divide(mat3x2 a, float b) { return mat3x2(exact_divide(a[0], b), exact_divide(a[1], b), exact_divide(a[2], b)); }
mat3x2 exact_divide(float a, mat3x2 b) { return mat3x2(exact_divide(a, b[0]), exact_divide(a, b[1]), exact_divide(a, b[2])); }
mat3 exact_divide(mat3 a, float b) { return mat3(exact_divide(a[0], b), exact_divide(a[1], b), exact_divide(a[2], b)); }
mat3 exact_divide(float a, mat3 b) { return mat3(exact_divide(a, b[0]), exact_divide(a, b[1]), exact_divide(a, b[2])); }
mat3x4 exact_divide(mat3x4 a, float b) { return mat3x4(exact_divide(a[0], b), exact_divide(a[1], b), exact_divide(a[2], b)); }
mat3x4 exact_divide(float a, mat3x4 b) { return mat3x4(exact_divide(a, b[0]), exact_divide(a, b[1]), exact_divide(a, b[2])); }
mat4x2 exact_divide(mat4x2 a, float b) { return mat4x2(exact_divide(a[0], b), exact_divide(a[1], b), exact_divide(a[2], b), exact_divide(a[3], b)); }
mat4x2 exact_divide(float a, mat4x2 b) { return mat4x2(exact_divide(a, b[0]), exact_divide(a, b[1]), exact_divide(a, b[2]), exact_divide(a, b[3])); }
mat4x3 exact_divide(mat4x3 a, float b) { return mat4x3(exact_divide(a[0], b), exact_divide(a[1], b), exact_divide(a[2], b), exact_divide(a[3], b)); }
mat4x3 exact_divide(float a, mat4x3 b) { return mat4x3(exact_divide(a, b[0]), exact_divide(a, b[1]), exact_divide(a, b[2]), exact_divide(a, b[3])); }
mat4 exact_divide(mat4 a, float b) { return mat4(exact_divide(a[0], b), exact_divide(a[1], b), exact_divide(a[2], b), exact_divide(a[3], b)); }
mat4 exact_divide(float a, mat4 b) { return mat4(exact_divide(a, b[0]), exact_divide(a, b[1]), exact_divide(a, b[2]), exact_divide(a, b[3])); }
mat2 exact_matrixCompMult(mat2 a, mat2 b) { return mat2(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1])); }
mat2x3 exact_matrixCompMult(mat2x3 a, mat2x3 b) { return mat2x3(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1])); }
mat2x4 exact_matrixCompMult(mat2x4 a, mat2x4 b) { return mat2x4(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1])); }
mat3x2 exact_matrixCompMult(mat3x2 a, mat3x2 b) { return mat3x2(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1]), exact_multiply(a[2], b[2])); }
mat3 exact_matrixCompMult(mat3 a, mat3 b) { return mat3(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1]), exact_multiply(a[2], b[2])); }
mat3x4 exact_matrixCompMult(mat3x4 a, mat3x4 b) { return mat3x4(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1]), exact_multiply(a[2], b[2])); }
mat4x2 exact_matrixCompMult(mat4x2 a, mat4x2 b) { return mat4x2(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1]), exact_multiply(a[2], b[2]), exact_multiply(a[3], b[3])); }
mat4x3 exact_matrixCompMult(mat4x3 a, mat4x3 b) { return mat4x3(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1]), exact_multiply(a[2], b[2]), exact_multiply(a[3], b[3])); }
mat4 exact_matrixCompMult(mat4 a, mat4 b) { return mat4(exact_multiply(a[0], b[0]), exact_multiply(a[1], b[1]), exact_multiply(a[2], b[2]), exact_multiply(a[3], b[3])); }

// column * row
mat2 exact_outerProduct(vec2 column, vec2 row) { return mat2(exact_multiply(column, row.x), exact_multiply(column, row.y)); }
mat2x3 exact_outerProduct(vec3 column, vec2 row) { return mat2x3(exact_multiply(column, row.x), exact_multiply(column, row.y)); }
mat2x4 exact_outerProduct(vec4 column, vec2 row) { return mat2x4(exact_multiply(column, row.x), exact_multiply(column, row.y)); }
mat3x2 exact_outerProduct(vec2 column, vec3 row) { return mat3x2(exact_multiply(column, row.x), exact_multiply(column, row.y), exact_multiply(column, row.z)); }
mat3 exact_outerProduct(vec3 column, vec3 row) { return mat3(exact_multiply(column, row.x), exact_multiply(column, row.y), exact_multiply(column, row.z)); }
mat3x4 exact_outerProduct(vec4 column, vec3 row) { return mat3x4(exact_multiply(column, row.x), exact_multiply(column, row.y), exact_multiply(column, row.z)); }
mat4x2 exact_outerProduct(vec2 column, vec4 row) { return mat4x2(exact_multiply(column, row.x), exact_multiply(column, row.y), exact_multiply(column, row.z), exact_multiply(column, row.w)); }
mat4x3 exact_outerProduct(vec3 column, vec4 row) { return mat4x3(exact_multiply(column, row.x), exact_multiply(column, row.y), exact_multiply(column, row.z), exact_multiply(column, row.w)); }
mat4 exact_outerProduct(vec4 column, vec4 row) { return mat4(exact_multiply(column, row.x), exact_multiply(column, row.y), exact_multiply(column, row.z), exact_multiply(column, row.w)); }

// d on the diagonal, z elsewhere
mat2 exact_diagonal_2(float d, float z) { return mat2(d, z, z, d); }
mat3 exact_diagonal_3(float d, float z) { return mat3(d, z, z, z, d, z, z, z, d); }
mat4 exact_diagonal_4(float d, float z) { return mat4(d, z, z, z, z, d, z, z, z, z, d, z, z, z, z, d); }

// by column
mat2 exact_unseen(mat2 m, float zero) { return mat2(exact_unseen(m[0], zero), exact_unseen(m[1], zero)); }
mat2x3 exact_unseen(mat2x3 m, float zero) { return mat2x3(exact_unseen(m[0], zero), exact_unseen(m[1], zero)); }
mat2x4 exact_unseen(mat2x4 m, float zero) { return mat2x4(exact_unseen(m[0], zero), exact_unseen(m[1], zero)); }
mat3x2 exact_unseen(mat3x2 m, float zero) { return mat3x2(exact_unseen(m[0], zero), exact_unseen(m[1], zero), exact_unseen(m[2], zero)); }
mat3 exact_unseen(mat3 m, float zero) { return mat3(exact_unseen(m[0], zero), exact_unseen(m[1], zero), exact_unseen(m[2], zero)); }
mat3x4 exact_unseen(mat3x4 m, float zero) { return mat3x4(exact_unseen(m[0], zero), exact_unseen(m[1], zero), exact_unseen(m[2], zero)); }
mat4x2 exact_unseen(mat4x2 m, float zero) { return mat4x2(exact_unseen(m[0], zero), exact_unseen(m[1], zero), exact_unseen(m[2], zero), exact_unseen(m[3], zero)); }
mat4x3 exact_unseen(mat4x3 m, float zero) { return mat4x3(exact_unseen(m[0], zero), exact_unseen(m[1], zero), exact_unseen(m[2], zero), exact_unseen(m[3], zero)); }
mat4 exact_unseen(mat4 m, float zero) { return mat4(exact_unseen(m[0], zero), exact_unseen(m[1], zero), exact_unseen(m[2], zero), exact_unseen(m[3], zero)); }

float exact_determinant(mat2 m) {
  precise float value = m[0].x * m[1].y - m[1].x * m[0].y;
  return value;
}

// expanded by the first column
float exact_determinant(mat3 m) {
  precise float value = (m[0].x * (m[1].y * m[2].z - m[2].y * m[1].z) - m[0].y * (m[1].x * m[2].z - m[2].x * m[1].z)) +
                        m[0].z * (m[1].x * m[2].y - m[2].x * m[1].y);
  return value;
}

mat2 exact_inverse(mat2 m) {
  precise float scale = 1.0 / exact_determinant(m);
  return exact_multiply(mat2(m[1].y, -m[0].y, -m[1].x, m[0].x), scale);
}

// adjugate over determinant: its rows are cross products of columns
mat3 exact_inverse(mat3 m) {
  precise vec3 r0 = m[1].yzx * m[2].zxy - m[1].zxy * m[2].yzx;
  precise vec3 r1 = m[2].yzx * m[0].zxy - m[2].zxy * m[0].yzx;
  precise vec3 r2 = m[0].yzx * m[1].zxy - m[0].zxy * m[1].yzx;
  precise float scale = 1.0 / exact_dot(m[0], r0);
  return exact_multiply(mat3(r0.x, r1.x, r2.x, r0.y, r1.y, r2.y, r0.z, r1.z, r2.z), scale);
}

// Laplace expansion by complementary minors of the first two and the last two rows.
struct ExactMinors {
  vec3 upper0, upper1;  // rows 0 and 1: columns 01 02 03, 12 13 23
  vec3 lower0, lower1;  // rows 2 and 3, the same columns
};

ExactMinors exact_minors(mat4 m) {
  precise vec3 upper0 = m[0].xxx * vec3(m[1].y, m[2].y, m[3].y) - vec3(m[1].x, m[2].x, m[3].x) * m[0].yyy;
  precise vec3 upper1 = vec3(m[1].x, m[1].x, m[2].x) * vec3(m[2].y, m[3].y, m[3].y) -
                        vec3(m[2].x, m[3].x, m[3].x) * vec3(m[1].y, m[1].y, m[2].y);
  precise vec3 lower0 = m[0].zzz * vec3(m[1].w, m[2].w, m[3].w) - vec3(m[1].z, m[2].z, m[3].z) * m[0].www;
  precise vec3 lower1 = vec3(m[1].z, m[1].z, m[2].z) * vec3(m[2].w, m[3].w, m[3].w) -
                        vec3(m[2].z, m[3].z, m[3].z) * vec3(m[1].w, m[1].w, m[2].w);
  return ExactMinors(upper0, upper1, lower0, lower1);
}

float exact_determinant(mat4 m) {
  ExactMinors s = exact_minors(m);
  precise float value = ((s.upper0.x * s.lower1.z - s.upper0.y * s.lower1.y) + (s.upper0.z * s.lower1.x + s.upper1.x * s.lower0.z)) -
                        (s.upper1.y * s.lower0.y - s.upper1.z * s.lower0.x);
  return value;
}

// Column j of the inverse from the minors that leave out row j.
mat4 exact_inverse(mat4 m) {
  ExactMinors s = exact_minors(m);
  precise float scale = 1.0 / exact_determinant(m);
  precise vec4 c0 = vec4((m[1].y * s.lower1.z - m[2].y * s.lower1.y) + m[3].y * s.lower1.x,
                         (-m[0].y * s.lower1.z + m[2].y * s.lower0.z) - m[3].y * s.lower0.y,
                         (m[0].y * s.lower1.y - m[1].y * s.lower0.z) + m[3].y * s.lower0.x,
                         (-m[0].y * s.lower1.x + m[1].y * s.lower0.y) - m[2].y * s.lower0.x);
  precise vec4 c1 = vec4((-m[1].x * s.lower1.z + m[2].x * s.lower1.y) - m[3].x * s.lower1.x,
                         (m[0].x * s.lower1.z - m[2].x * s.lower0.z) + m[3].x * s.lower0.y,
                         (-m[0].x * s.lower1.y + m[1].x * s.lower0.z) - m[3].x * s.lower0.x,
                         (m[0].x * s.lower1.x - m[1].x * s.lower0.y) + m[2].x * s.lower0.x);
  precise vec4 c2 = vec4((m[1].w * s.upper1.z - m[2].w * s.upper1.y) + m[3].w * s.upper1.x,
                         (-m[0].w * s.upper1.z + m[2].w * s.upper0.z) - m[3].w * s.upper0.y,
                         (m[0].w * s.upper1.y - m[1].w * s.upper0.z) + m[3].w * s.upper0.x,
                         (-m[0].w * s.upper1.x + m[1].w * s.upper0.y) - m[2].w * s.upper0.x);
  precise vec4 c3 = vec4((-m[1].z * s.upper1.z + m[2].z * s.upper1.y) - m[3].z * s.upper1.x,
                         (m[0].z * s.upper1.z - m[2].z * s.upper0.z) + m[3].z * s.upper0.y,
                         (-m[0].z * s.upper1.y + m[1].z * s.upper0.z) - m[3].z * s.upper0.x,
                         (m[0].z * s.upper1.x - m[1].z * s.upper0.y) + m[2].z * s.upper0.x);
  precise vec4 s0 = c0 * scale;
  precise vec4 s1 = c1 * scale;
  precise vec4 s2 = c2 * scale;
  precise vec4 s3 = c3 * scale;
  return mat4(s0, s1, s2, s3);
}
