// In place of technique/surface_flat.glsl where OpenGL is timed: the driver's own filter.
in vec2 v_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;  // linear RGB; layer: the material

void load_surface_maps() {
}

vec3 surface_albedo() {
  return texture(albedo_maps, vec3(v_uv, float(v_material))).rgb;
}

// In tangent space, z up.
vec3 surface_normal() {
  return vec3(0.0, 0.0, 1.0);
}
