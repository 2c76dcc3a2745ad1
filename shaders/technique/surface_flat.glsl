// The surface without its normal map, which is not read: for light that does not depend on the normal. In place of surface.glsl.
#include "exact/bilinear.glsl"

in vec2 v_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;  // linear RGB; layer: the material

vec3 albedo_texel;

void load_surface_maps() {
  ExactTaps taps = exact_taps_repeat(v_uv, textureSize(albedo_maps, 0).xy);
  albedo_texel = exact_fetch(albedo_maps, taps, v_material).rgb;
}

vec3 surface_albedo() {
  return albedo_texel;
}

// In tangent space, z up.
vec3 surface_normal() {
  return vec3(0.0, 0.0, 1.0);
}
