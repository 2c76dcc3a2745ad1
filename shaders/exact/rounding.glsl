// sqrt, min, max, clamp and step as functions of one operation each; rounding, signs and classes written out.

#define EXACT_OF_1(type, name, function) type name(type x) { precise type value = function(x); return value; }
#define EXACT_OF_2(type, right, name, function) \
  type name(type a, right b) { precise type value = function(a, b); return value; }
#define EXACT_CLAMP(type, limit) \
  type exact_clamp(type x, limit low, limit high) { precise type value = clamp(x, low, high); return value; }
#define EXACT_STEP(type, edge) type exact_step(edge e, type x) { precise type value = step(e, x); return value; }
#define EXACT_FOR_TYPE(type)                                                                       \
  EXACT_OF_1(type, exact_sqrt, sqrt)                                                               \
  EXACT_OF_2(type, type, exact_min, min) EXACT_OF_2(type, type, exact_max, max)                    \
  EXACT_CLAMP(type, type) EXACT_STEP(type, type)
#define EXACT_FOR_VECTOR(type)                                                                     \
  EXACT_FOR_TYPE(type)                                                                             \
  EXACT_OF_2(type, float, exact_min, min) EXACT_OF_2(type, float, exact_max, max)                  \
  EXACT_CLAMP(type, float) EXACT_STEP(type, float)

EXACT_FOR_TYPE(float)
EXACT_FOR_VECTOR(vec2)
EXACT_FOR_VECTOR(vec3)
EXACT_FOR_VECTOR(vec4)

// To the nearest integer, halves to the even one: adding 2^23 leaves no bits below one. round(-0) is 0.
float exact_round(float x) {
  precise float magnitude = abs(x);
  precise float whole = (magnitude + 8388608.0) - 8388608.0;
  magnitude = magnitude < 8388608.0 ? whole : magnitude;
  return x < 0.0 ? -magnitude : magnitude;
}

float exact_sign(float x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }  // of NaN: 0

bool exact_isnan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool exact_isinf(float x) { return (floatBitsToUint(x) & 0x7fffffffu) == 0x7f800000u; }
