// ?: of structures and arrays, where all lanes agree on the condition and where they do not.
#version 450
struct Pair { float first; float second; };
uniform float u;
uniform int n;
uniform float left[4];
uniform float right[4];
layout(location = 0) flat in int a;
layout(location = 0) out vec4 structures;
layout(location = 1) out vec4 arrays;
Pair picked(bool c, Pair p, Pair q) {
  if (c) return p;
  return q;
}
void main() {
  Pair p = Pair(u, 1.0), q = Pair(2.0, u);
  Pair same = u > 0.0 ? p : q, own = a > 3 ? p : q, given = picked(n > 3, p, q);
  Pair ps[2] = Pair[2](p, q), qs[2] = Pair[2](q, p), pairs[2];
  pairs = n > 3 ? ps : qs;
  structures = vec4(same.first + same.second * 10.0, own.first + own.second * 10.0, given.first, pairs[n & 1].second);
  const float fixed_numbers[4] = float[4](1.0, 2.0, 3.0, 4.0);
  float numbers[4] = float[4](5.0, 6.0, 7.0, u);
  float uniform_choice[4] = u > 0.0 ? left : right, lane_choice[4] = a > 3 ? left : right;
  float mixed[4] = n > 3 ? fixed_numbers : numbers, of_lanes[4] = a > 3 ? fixed_numbers : numbers;
  arrays = vec4(uniform_choice[0] + left[a & 3] * 10.0, lane_choice[a & 3] + right[a & 3] * 10.0, mixed[1], of_lanes[2]);
}
