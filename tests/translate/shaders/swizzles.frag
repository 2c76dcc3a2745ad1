#version 450
in vec4 v;
layout(location = 0) out vec4 plain;
layout(location = 1) out vec4 written;
layout(location = 2) out vec4 dynamic;
layout(location = 3) flat in int k;
void main() {
  plain = vec4(v.wz, v.xx.y, v.zyx[1]);
  vec4 w = v;
  w.zx = w.xz;              // through a copy: a swap
  w.yw *= vec2(2.0, 3.0);
  if (v.x > 3.0) w.wzy = vec3(10.0, 20.0, 30.0);
  w.xy.x += 100.0;
  written = w;
  written.wzyx = written.wzyx;  // every component
  vec4 d = v;
  d[k] = 7.0;
  d[(k + 1) & 3] += d[k];
  if (v.x > 3.0) d[k] = -1.0;
  dynamic = d;
}
