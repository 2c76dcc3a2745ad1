#version 450
layout(location = 0) flat in int a;
layout(location = 1) flat in int b;
layout(location = 0) out ivec4 answer;
void reject(int limit) {
  if (a + b > limit) discard;
}
int guarded(int n) {
  int steps = 0;
  while (true) {  // invocations that discard here would never leave
    steps++;
    if (steps > n + 2) break;
    if (n == 6 && steps == 3) discard;
    if (n == 6) steps = 2;
  }
  return steps;
}
int never(int n) {
  do {
    discard;
    return n;
  } while (false);
  return n;
}
void main() {
  if (a == 3) discard;
  answer = ivec4(a, b, 0, 0);
  if (b == 5) {
    if (a == 2) { answer.x = 1; discard; }
    answer.z = 1;
  }
  reject(11);
  for (int i = 0; i < 3; i++) if (i == b && a == 0) discard;
  answer.w = guarded(a);
  // among lanes that go on
  if (a == 7) { while (true) { answer.x = 2; discard; } }
  if (b == 6) { for (int i = 0; i < 3; i++) { answer.y = 2; discard; } }
  if (b == 7 && a > 0) answer.x = never(a);
  if (gl_HelperInvocation) answer.z = 99;
}
