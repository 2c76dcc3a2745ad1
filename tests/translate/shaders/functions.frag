// The built-in functions, each where its arguments are valid, and bits.
#version 450
layout(location = 0) in vec3 v;
layout(location = 1) flat in int k;
layout(location = 0) out vec4 rounding;
layout(location = 1) out vec4 choosing;
layout(location = 2) out vec4 geometry;
layout(location = 3) out ivec4 integers;
layout(location = 4) out ivec4 bits;
layout(location = 5) out vec4 matrices;
void main() {
  float whole;
  float part = modf(v.x, whole);
  rounding = vec4(floor(v.x) + ceil(v.y) * 10.0 + trunc(v.z) * 100.0, roundEven(v.x) + fract(v.y), part + whole * 10.0, mod(v.x, 3.0));
  choosing = vec4(min(v, 2.0).x + max(v.yzx, vec3(1.0)).x, clamp(v, 0.0, 1.0).z, mix(v.x, v.y, 0.25) + step(2.0, v.x),
                  smoothstep(0.0, 4.0, v.y) + sign(v.z) + abs(v.z));
  geometry = vec4(dot(v, vec3(1.0, 2.0, 3.0)), cross(v, vec3(0.0, 0.0, 1.0)).x, length(vec2(3.0, 4.0)) + sqrt(16.0 + 0.0 * v.x),
                  reflect(v, vec3(0.0, 1.0, 0.0)).y);
  integers = ivec4(bitCount(uint(k) * 5u), findMSB(k + 1), findLSB(k + 8), bitfieldExtract(k * 37, 2, 3) + bitfieldInsert(0, k, 4, 4));
  bits = ivec4(floatBitsToInt(v.x), int(floatBitsToUint(-v.y)), floatBitsToInt(intBitsToFloat(k)), int(packUnorm4x8(vec4(0.0, 1.0, 0.5, 0.0))));
  mat2 m = mat2(v.x, v.y, 1.0, 4.0);
  mat2 product = m * inverse(m) + matrixCompMult(m, m) * 0.0;
  mat3 outer = outerProduct(v, vec3(1.0, 2.0, 3.0));
  bool same = m == transpose(transpose(m));
  matrices = vec4(product[0][0], product[1][0], outer[2][1], same ? determinant(m) : 0.0);
}
