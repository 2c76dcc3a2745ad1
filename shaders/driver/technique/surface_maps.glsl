// In place of technique/surface_maps.glsl where OpenGL is timed: the driver's own filter.
#include "exact/normalize.glsl"

in vec2 v_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;   // linear RGB
uniform sampler2DArray normal_maps;   // decoded tangent-space unit normals in RGB

void load_surface_maps() {
}

vec3 surface_albedo() {
  return texture(albedo_maps, vec3(v_uv, float(v_material))).rgb;
}

// In tangent space, z up.
vec3 mapped_normal() {
  return exact_normalize(texture(normal_maps, vec3(v_uv, float(v_material))).rgb);
}
