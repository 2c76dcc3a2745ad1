// Natural logarithm, from that to base 2.
#include "exact/log2.glsl"

float exact_log(float x) {
  precise float value = exact_log2(x) * 0.693147182;  // ln 2
  return value;
}
