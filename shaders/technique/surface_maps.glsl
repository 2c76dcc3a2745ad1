// What textures say of the surface. Layer of both arrays: the material. Texture coordinates repeat.
#include "exact/bilinear.glsl"
#include "exact/normalize.glsl"

in vec2 v_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;   // linear RGB
uniform sampler2DArray normal_maps;   // decoded tangent-space unit normals in RGB

vec3 surface_albedo() {
  return exact_bilinear_2d_array_repeat(albedo_maps, v_uv, v_material).rgb;
}

// In tangent space, z up.
vec3 mapped_normal() {
  return exact_normalize(exact_bilinear_2d_array_repeat(normal_maps, v_uv, v_material).rgb);
}
