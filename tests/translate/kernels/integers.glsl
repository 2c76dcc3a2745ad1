ivec4 kernel(int a, int b, float x, float y) {
  uint u = uint(a) * 2654435761u + uint(b);
  uint v = u ^ (u >> 13);
  v = (v << 7) | (v & 127u);
  v += ~u;
  uint d = uint(b) + 1u;
  int c = a - 4, e = b - 8;
  int shifted = (c >> 1) + ((a << 3) & 20);
  int f = int(x * 10.0f) - int(y * -3.7f);
  uint g = uint(x * 3.0f);
  float back = float(c) * 0.5f + float(g);
  bool t = bool(a), z = bool(b - 3);
  int q = c / (e == 0 ? 1 : e);
  return ivec4(int(v % d) + int(v / d % 1000u), shifted * 100 + q, f, int(back * 4.0f) * 10 + int(t) * 2 + int(z));
}
