int first_over(int limit, int step) {
  int v = 0;
  for (int i = 0; i < 12; i++) {
    v += step + i;
    if (v > limit) return i;
    if (v == 5) return -5;
  }
  return 100;
}
float clamped(float v) {
  if (v < 1.0f) return 1.0f;
  if (v > 3.0f) return 3.0f;
  return v;
}
void split(int v, OUT(int) low, OUT(int) high) {
  low = v & 3;
  high = 0;
  if (v == 2) return;
  high = v >> 2;
  if (v > 5) { high += 10; return; }
  low += 1;
}
int search(int a, int b) {
  int n = 0;
  while (true) {
    n += a + 1;
    if (n > 20) {
      if (b > 3) return n;
      for (int k = 0; k < 4; k++) { if (k == b) return n * 10; n++; }
    }
  }
}
// Loops whose bodies end in a return: the lanes that are left come to no second iteration.
int once(int v) {
  do {
    if (v > 4) break;
    return 3;
  } while (false);
  return 4;
}
int at_most_once(int n) {
  for (int i = 0; i < n; i++) return i + 7;
  return 4;
}
int nested_once(int v) {
  do {
    v++;
    if (v > 4) break;
    do {
      if (v == 3) break;
      return v;
    } while (false);
    v += 100;
  } while (v < 3);
  return v + 1000;
}
ivec4 kernel(int a, int b, float x, float y) {
  int low, high;
  split(a, low, high);
  if (a == 3 && b == 3) return ivec4(1, 2, 3, 4);
  if (x > 2.5f) {
    split(b, high, low);
    if (y > x) return ivec4(low, high, int(clamped(x) * 8.0f), -1);
  }
  if (b == 7) return ivec4(once(a), at_most_once(a - 2), nested_once(a), 0);
  return ivec4(first_over(a * 3, b), low * 100 + high, int(clamped(x) * 8.0f), search(a, b));
}
