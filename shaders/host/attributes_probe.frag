// Exact attributes evaluated in a fragment shader, from vertex data given flat: what the rasterizer's own evaluation is held to.
#include "exact/attributes.glsl"

flat in vec4 p0, p1, p2;  // clip-space vertices of the triangle
flat in vec3 a;           // an attribute at the three
uniform vec2 ndc_scale;   // 2 / viewport

layout(location = 0) out vec4 color;

void main() {
  precise vec2 ndc = gl_FragCoord.xy * ndc_scale - 1.0;
  ExactBarycentrics b = exact_barycentrics(p0, p1, p2, ndc);
  color = vec4(exact_interpolate(a.x, a.y, a.z, b.weight), b.depth, b.reciprocal_w, b.front_facing ? 1.0 : 0.0);
}
