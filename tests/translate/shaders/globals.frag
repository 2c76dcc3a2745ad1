// Variables outside functions, written by functions under masks; inputs that are arrays; several outputs.
#version 450
layout(location = 0) flat in int a;
layout(location = 1) in vec3 samples[3];
layout(location = 4) in mat2 frame;
layout(location = 0) out float single;
layout(location = 1) out ivec2 pair;
layout(location = 2) out vec2 list[2];
float state = 1.0;
int counter;
const float factor = 2.0;
void advance(float by) {
  if (by > 2.0) { state += by; return; }
  state -= by * factor;
  counter++;
}
void main() {
  for (int i = 0; i < 3; i++) {
    advance(samples[i].y);
    if (i == a) break;
  }
  single = state + samples[a % 3].x;
  pair.y = counter;
  pair.x = a;
  if (a > 4) pair = -pair;
  list[0] = frame[1];
  list[a & 1] += vec2(1.0, 2.0);
}
