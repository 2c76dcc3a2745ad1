// tan(x) = sin(x) / cos(x), and atan(t), which is the angle of (1, t).
#include "exact/atan2.glsl"
#include "exact/sin_cos.glsl"

float exact_tan(float x) {
  precise float value = exact_sin(x) / exact_cos(x);
  return value;
}

float exact_atan(float t) { return exact_atan2(t, 1.0); }
