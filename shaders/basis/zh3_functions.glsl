// ZH3: what its two forms share. Roughton, Sloan, Silvennoinen, Iwanicki and Shirley, ZH3: Quadratic Zonal Harmonics, I3D 2024.
// Spherical harmonics l <= 1 and one zonal function of l = 2, about the direction that the luminance of l = 1 points to.
#include "basis/luminance_functions.glsl"
#include "basis/sh_functions.glsl"
#include "exact/dot.glsl"

// The zonal axis, from coefficients 1 to 3 (index l*l + l + m, factor (-1)^m). Where l = 1 has no luminance, or none that a
// float's square can hold, there is no axis: the zero vector.
vec3 zh3_axis(vec3 c1, vec3 c2, vec3 c3) {
  vec3 towards = vec3(-luminance(c3), -luminance(c1), luminance(c2));
  precise float square = exact_dot(towards, towards);
  precise float scale = 1.0 / sqrt(square);
  precise vec3 axis = towards * scale;
  return square > 1.17549435e-38 ? axis : vec3(0.0);  // 2^-126
}

// The zonal function of l = 2 about the axis; 0 where there is none.
float zh3_zonal(vec3 n, vec3 axis) {
  precise float cosine = exact_dot(n, axis);
  precise float value = (cosine * cosine) * 0.946174696 - 0.315391565;  // sqrt(5/16pi) (3 cos^2 - 1)
  bool none = axis.x == 0.0 && axis.y == 0.0 && axis.z == 0.0;
  return none ? 0.0 : value;
}

vec3 zh3_linear(vec3 n, vec3 c0, vec3 c1, vec3 c2, vec3 c3) {
  precise vec3 irradiance = c0 * sh_0();
  irradiance += c1 * sh_1(n);
  irradiance += c2 * sh_2(n);
  irradiance += c3 * sh_3(n);
  return irradiance;
}
