#version 450
in float x;
in vec4 tint;
out vec4 tinted;
out float y;
void main() {
  tinted = x * tint;
  y = x * 100.0;
}
