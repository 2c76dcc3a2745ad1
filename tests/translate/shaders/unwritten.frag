// Variables that are read where only other lanes, or none, have written them.
#version 450
uniform int n;
layout(location = 0) flat in int a;
layout(location = 0) out ivec4 answer;
void main() {
  int some[2], none[2], late[2];
  if (a > 3) some = int[2](1, 2);
  if (n > 3) none = int[2](3, 4);
  int sum = 0;
  for (int i = 0; i < 2; i++) {
    sum += late[a & 1];
    late = int[2](10, 20);
  }
  answer = ivec4(some[0], some[a & 1], none[1], sum);
}
