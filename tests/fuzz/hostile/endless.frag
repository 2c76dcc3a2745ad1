#version 450
flat in int n;
out vec4 color;
void main() {
  float s = 0.0;
  for (int i = 0; i != n; i += 2) {
    switch (i & 3) {
      case 0: continue;
      case 1: s += 1.0;
      default: break;
    }
    while (s > 1.0) s -= 0.5;
  }
  color = vec4(s);
}
