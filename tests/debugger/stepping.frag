#version 450
in float x;
out vec4 color;

float twice(float v) {
  float sum = v + v;
  return sum;
}

void main() {
  float a = x * 3.0;
  float b = twice(a);
  if (b > 10.0) {
    b = b - 1.0;
  }
  for (int i = 0; i < 2; ++i) {
    b = b + 0.5;
  }
  color = vec4(b);
}
