// The surface as textures give it, its normal in world space.
#include "technique/surface_maps.glsl"
#include "exact/cross.glsl"

in vec3 v_normal;   // world space
in vec4 v_tangent;  // world space; w: +1 or -1, bitangent = w * cross(normal, tangent)

// In world space.
vec3 surface_normal() {
  vec3 mapped = mapped_normal();
  vec3 bitangent = exact_cross(v_normal, v_tangent.xyz);
  precise vec3 normal = (v_tangent.xyz * mapped.x + (bitangent * v_tangent.w) * mapped.y) + v_normal * mapped.z;
  return exact_normalize(normal);
}
