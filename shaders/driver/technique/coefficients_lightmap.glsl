// In place of technique/coefficients_lightmap.glsl where OpenGL is timed: the driver's own filter.

in vec2 v_lightmap_uv;
uniform sampler2DArray COEFFICIENTS;  // RGB

void load_coefficients() {
}

#define COEF(i) texture(COEFFICIENTS, vec3(v_lightmap_uv, float(i))).rgb
