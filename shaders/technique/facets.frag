// The geometric normal of each triangle, from the derivatives of the position, as colour.
#include "exact/cross.glsl"
#include "exact/normalize.glsl"

in vec3 v_position;
out vec4 color;

void main() {
  vec3 normal = exact_normalize(exact_cross(dFdx(v_position), dFdy(v_position)));
  precise vec3 shown = normal * 0.5 + 0.5;
  color = vec4(shown, 1.0);
}
