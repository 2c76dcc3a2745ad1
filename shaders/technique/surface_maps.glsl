// What textures say of the surface. Layer of both arrays: the material. Texture coordinates repeat. load_surface_maps() comes before
// the others.
#include "exact/bilinear.glsl"
#include "exact/normalize.glsl"

in vec2 v_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;   // linear RGB
uniform sampler2DArray normal_maps;   // decoded tangent-space unit normals in RGB

vec3 albedo_texel, normal_texel;

void load_surface_maps() {
  ivec2 size = textureSize(albedo_maps, 0).xy;
  ivec2 normal_size = textureSize(normal_maps, 0).xy;
  ExactTaps taps = exact_taps_repeat(v_uv, size);
  if (size == normal_size) {
    mat2x4 texels = exact_fetch_pair(albedo_maps, normal_maps, taps, v_material);
    albedo_texel = texels[0].rgb;
    normal_texel = texels[1].rgb;
  } else {
    albedo_texel = exact_fetch(albedo_maps, taps, v_material).rgb;
    normal_texel = exact_bilinear_2d_array_repeat(normal_maps, v_uv, v_material).rgb;
  }
}

vec3 surface_albedo() {
  return albedo_texel;
}

// In tangent space, z up.
vec3 mapped_normal() {
  return exact_normalize(normal_texel);
}
