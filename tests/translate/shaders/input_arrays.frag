// Elements of input arrays outside them, by indices of both kinds that are the same for all lanes or not.
#version 450
uniform int below;
uniform int above;
uniform uint far;
layout(location = 0) flat in int a;
layout(location = 1) in float samples[3];
layout(location = 0) out vec4 same;
layout(location = 1) out vec4 own;
void main() {
  same = vec4(samples[below], samples[above], samples[far], samples[above - 3]);
  own = vec4(samples[below + a], samples[above + a], samples[far + uint(a)], samples[a - 3]);
}
