// / sqrt min max clamp of the exact dialect in integer arithmetic: for graphics cards, whose own may be some ULP off (GLSL
// 4.60, section 4.7.1: division 2.5 ULP) and pick either zero. Operands and results below 2^-126
// in magnitude count as 0, as everywhere in fragment shaders (docs/exact-dialect.md).
//
// Rounding to nearest even; a NaN operand comes back quiet, the first one's; what has no value is 0xffc00000, x86's NaN.

const uint WRITTEN_NAN = 0xffc00000u, WRITTEN_INFINITY = 0x7f800000u, WRITTEN_LEADING_BIT = 0x800000u;

bool written_isnan(uint bits) { return (bits & 0x7fffffffu) > WRITTEN_INFINITY; }
bool written_isinf(uint bits) { return (bits & 0x7fffffffu) == WRITTEN_INFINITY; }
uint written_exponent(uint bits) { return (bits >> 23) & 0xffu; }
uint written_significand(uint bits) { return (bits & 0x7fffffu) | WRITTEN_LEADING_BIT; }

// 24 bits of 25, of which the last is half a unit; inexact: something follows it.
uint written_round(uint bits, bool inexact) {
  uint kept = bits >> 1;
  bool up = (bits & 1u) != 0u && (inexact || (kept & 1u) != 0u);
  return up ? kept + 1u : kept;
}

float written_divide(float a, float b) {
  uint x = floatBitsToUint(a), y = floatBitsToUint(b);
  uint sign = (x ^ y) & 0x80000000u;
  bool x_zero = written_exponent(x) == 0u, y_zero = written_exponent(y) == 0u;
  if (written_isnan(x)) return uintBitsToFloat(x | 0x400000u);
  if (written_isnan(y)) return uintBitsToFloat(y | 0x400000u);
  if ((x_zero && y_zero) || (written_isinf(x) && written_isinf(y))) return uintBitsToFloat(WRITTEN_NAN);
  if (written_isinf(x) || y_zero) return uintBitsToFloat(sign | WRITTEN_INFINITY);
  if (x_zero || written_isinf(y)) return uintBitsToFloat(sign);

  // The significands' quotient in [1, 2), bit by bit: a leading 1, then 24 more.
  uint divisor = written_significand(y), remainder = written_significand(x);
  int exponent = int(written_exponent(x)) - int(written_exponent(y)) + 127;
  bool smaller = remainder < divisor;
  exponent = smaller ? exponent - 1 : exponent;
  remainder = (smaller ? remainder << 1 : remainder) - divisor;
  uint quotient = 1u;
  for (int i = 0; i < 24; ++i) {
    remainder <<= 1;
    bool taken = remainder >= divisor;
    remainder = taken ? remainder - divisor : remainder;
    quotient = (quotient << 1) | (taken ? 1u : 0u);
  }
  uint significand = written_round(quotient, remainder != 0u);
  exponent = significand == 2u * WRITTEN_LEADING_BIT ? exponent + 1 : exponent;
  if (exponent >= 255) return uintBitsToFloat(sign | WRITTEN_INFINITY);
  if (exponent <= 0) return uintBitsToFloat(sign);
  return uintBitsToFloat(sign | (uint(exponent) << 23) | (significand & 0x7fffffu));
}

float written_sqrt(float a) {
  uint x = floatBitsToUint(a);
  if (written_isnan(x)) return uintBitsToFloat(x | 0x400000u);
  if (written_exponent(x) == 0u) return uintBitsToFloat(x & 0x80000000u);
  if ((x & 0x80000000u) != 0u) return uintBitsToFloat(WRITTEN_NAN);
  if (written_isinf(x)) return a;

  // x = m 2^(2 half) / 2^23 with m in [2^23, 2^25); the root of m 2^25 bit by bit, from the radicand's bits in pairs.
  bool odd = (written_exponent(x) & 1u) == 0u;  // the bias is odd
  uint m = odd ? written_significand(x) << 1 : written_significand(x);
  uint exponent = (written_exponent(x) + (odd ? 126u : 127u)) >> 1;
  uint root = 0u, remainder = 0u;
  for (int shift = 23; shift >= -25; shift -= 2) {
    uint pair = (shift >= 0 ? m >> shift : m << -shift) & 3u;
    if (shift < -1) pair = 0u;
    remainder = (remainder << 2) | pair;
    uint trial = (root << 2) | 1u;
    bool taken = remainder >= trial;
    remainder = taken ? remainder - trial : remainder;
    root = (root << 1) | (taken ? 1u : 0u);
  }
  return uintBitsToFloat((exponent << 23) + written_round(root, remainder != 0u) - WRITTEN_LEADING_BIT);
}

uint written_operand(float a) {
  uint bits = floatBitsToUint(a);
  return written_exponent(bits) == 0u ? bits & 0x80000000u : bits;
}

// x < y of numbers. Not by floats: drivers take a comparison and a selection for their own min.
bool written_less(uint x, uint y) {
  int left = int(x), right = int(y);
  left = left < 0 ? left ^ 0x7fffffff : left;
  right = right < 0 ? right ^ 0x7fffffff : right;
  return ((x | y) & 0x7fffffffu) != 0u && left < right;
}

// Of 0 and -0 the second, of a number and NaN the number.
float written_min(float a, float b) {
  uint x = written_operand(a), y = written_operand(b);
  if (written_isnan(y)) return a;
  return uintBitsToFloat(!written_isnan(x) && written_less(x, y) ? x : y);
}
float written_max(float a, float b) {
  uint x = written_operand(a), y = written_operand(b);
  if (written_isnan(y)) return a;
  return uintBitsToFloat(!written_isnan(x) && written_less(y, x) ? x : y);
}
float written_clamp(float x, float low, float high) { return written_min(written_max(x, low), high); }

// What stands in arguments of the functions above, where `precise` does not reach.
float written_add(float a, float b) { precise float sum = a + b; return sum; }
float written_subtract(float a, float b) { precise float difference = a - b; return difference; }
float written_multiply(float a, float b) { precise float product = a * b; return product; }
