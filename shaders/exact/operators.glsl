// + - * / of floats as functions: each is one operation that no compiler may combine with another, fold in a different
// precision, or move. `twinshade check --make-exact` puts them in the place of a shader's operators.

#define EXACT_OPERATION(result, left, right, name, op) \
  result name(left a, right b) { precise result value = a op b; return value; }
#define EXACT_OPERATIONS(name, op)                                                                  \
  EXACT_OPERATION(float, float, float, name, op)                                                    \
  EXACT_OPERATION(vec2, vec2, vec2, name, op) EXACT_OPERATION(vec2, vec2, float, name, op)          \
  EXACT_OPERATION(vec2, float, vec2, name, op) EXACT_OPERATION(vec3, vec3, vec3, name, op)          \
  EXACT_OPERATION(vec3, vec3, float, name, op) EXACT_OPERATION(vec3, float, vec3, name, op)         \
  EXACT_OPERATION(vec4, vec4, vec4, name, op) EXACT_OPERATION(vec4, vec4, float, name, op)          \
  EXACT_OPERATION(vec4, float, vec4, name, op)

EXACT_OPERATIONS(exact_add, +)
EXACT_OPERATIONS(exact_subtract, -)
EXACT_OPERATIONS(exact_multiply, *)
EXACT_OPERATIONS(exact_divide, /)

// A vector with one component replaced; an index out of range replaces none.
vec2 exact_with(vec2 v, int i, float x) { return vec2(i == 0 ? x : v.x, i == 1 ? x : v.y); }
vec3 exact_with(vec3 v, int i, float x) { return vec3(i == 0 ? x : v.x, i == 1 ? x : v.y, i == 2 ? x : v.z); }
vec4 exact_with(vec4 v, int i, float x) {
  return vec4(i == 0 ? x : v.x, i == 1 ? x : v.y, i == 2 ? x : v.z, i == 3 ? x : v.w);
}

// A value that no compiler can know: with the bits of zero, a uniform that is 0, every bit stays as it is.
#define EXACT_UNSEEN(type, bits)                                              \
  type exact_unseen(type x, float zero) {                                     \
    return uintBitsToFloat(floatBitsToUint(x) | bits(floatBitsToUint(zero))); \
  }
#define EXACT_UNSEEN_INTEGER(type) \
  type exact_unseen(type x, float zero) { return x | type(floatBitsToUint(zero)); }

EXACT_UNSEEN(float, uint) EXACT_UNSEEN(vec2, uvec2) EXACT_UNSEEN(vec3, uvec3) EXACT_UNSEEN(vec4, uvec4)
EXACT_UNSEEN_INTEGER(int) EXACT_UNSEEN_INTEGER(ivec2) EXACT_UNSEEN_INTEGER(ivec3) EXACT_UNSEEN_INTEGER(ivec4)
EXACT_UNSEEN_INTEGER(uint) EXACT_UNSEEN_INTEGER(uvec2) EXACT_UNSEEN_INTEGER(uvec3) EXACT_UNSEEN_INTEGER(uvec4)
