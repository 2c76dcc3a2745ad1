// A matrix by a scalar is divided element by element, unless the shader multiplies by a reciprocal.
#version 450
uniform float scale;
layout(location = 0) in vec4 v;
layout(location = 0) out vec4 divided;
layout(location = 1) out vec4 by_uniform;
layout(location = 2) out vec4 times_reciprocal;
layout(location = 3) out vec4 assigned;
void main() {
  mat2 m = mat2(v.x, v.y, v.z, v.w);
  mat2 q = m / v.x;
  divided = vec4(q[0], q[1]);
  q = m / scale;
  by_uniform = vec4(q[0], q[1]);
  q = m * (1.0 / v.x);
  times_reciprocal = vec4(q[0], q[1]);
  m /= v.x + 1.0;
  assigned = vec4(m[0], m[1]);
}
