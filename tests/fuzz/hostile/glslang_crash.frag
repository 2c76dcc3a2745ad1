#version 450
struct S { float a; float m; };
in float x;
out vec4 color;
void main() {
  S s = S(x, x);
  S list[1] = S[1](s);
  precise float y = list[0].m + x;
  color = vec4(y);
}
