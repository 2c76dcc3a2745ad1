// Uniform and constant arrays that are indexed by lane, and copied, passed, returned, compared and put into structures whole.
#version 450
struct Holder { int a; ivec2 pairs[3]; int codes[3]; };
uniform ivec2 pairs[3];
uniform int codes[3];
const int table[5] = int[](3, -1, 4, 1, -5);
layout(location = 0) flat in int a;
layout(location = 0) out ivec4 answer;
int[3] chosen(int limit) {
  if (a > limit) return codes;
  int own[3] = int[3](a, limit, 2);
  return own;
}
ivec2[3] moved(ivec2 list[3]) {
  list[0] += a;
  return list;
}
void main() {
  int indexed = table[a % 5] + codes[a % 3] * 10 + pairs[a % 3].y * 100;
  ivec2 copy[3] = pairs;
  int other[5] = table;
  Holder holder = Holder(a, pairs, codes);
  bool same = codes == holder.codes && pairs == copy;
  int list[3] = chosen(2);
  if (a > 4) {
    copy = moved(pairs);
    copy[1] = ivec2(9);
    other = table;
    other[2] = 0;
  }
  answer = ivec4(indexed, list[a % 3] * 10 + int(same), copy[0].x * 10 + copy[1].y, other[2] * 10 + holder.pairs[2].x);
}
