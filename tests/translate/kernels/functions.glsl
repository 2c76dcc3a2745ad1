int counter = 3;
int calls = 0;
int bump(int by) { counter += by; calls++; return counter; }
void swap_if(bool really, INOUT(int) p, INOUT(int) q) {
  if (really) { int t = p; p = q; q = t; }
}
int own_copy(int v) { v *= 2; v += 1; return v; }
void twice(INOUT(int) v) { v = own_copy(v); v = own_copy(v); }
int same_for_all(int v, int k) { return v * k + counter; }
void both(OUT(int) first, OUT(int) second, int v) { first = v; second = v + 1; first += second; }
ivec4 kernel(int a, int b, float x, float y) {
  int p = a, q = b;
  swap_if(p < q, p, q);
  if (x > y) bump(a);
  int r = bump(1) + counter * 1000;
  twice(p);
  if (b > 2) twice(q);
  int s = q + bump(q) - q;
  for (int i = 0; i < a; i++) { if (i == b) continue; bump(i); }
  int f, g;
  both(f, g, a * b);
  r += same_for_all(3, 4) + same_for_all(a, 4) + same_for_all(2, b);
  return ivec4(p, q * 7 + s, r, counter * 10000 + calls * 100 + f - g);
}
