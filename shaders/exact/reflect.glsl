// The direction `incident` mirrored at the plane with unit normal `normal`: I - 2 (N.I) N.
#include "exact/dot.glsl"

vec2 exact_reflect(vec2 incident, vec2 normal) {
  precise float twice = 2.0 * exact_dot(normal, incident);
  precise vec2 reflected = incident - normal * twice;
  return reflected;
}

vec3 exact_reflect(vec3 incident, vec3 normal) {
  precise float twice = 2.0 * exact_dot(normal, incident);
  precise vec3 reflected = incident - normal * twice;
  return reflected;
}

vec4 exact_reflect(vec4 incident, vec4 normal) {
  precise float twice = 2.0 * exact_dot(normal, incident);
  precise vec4 reflected = incident - normal * twice;
  return reflected;
}
