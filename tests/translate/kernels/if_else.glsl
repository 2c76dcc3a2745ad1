ivec4 kernel(int a, int b, float x, float y) {
  int r = 1, s = 0, t;
  if (a > b) {
    r = a;
    if (x < y) r += 10;
    else if (x == 1.0f) s = 5;
    else { s = 7; r -= 3; }
  } else {
    s = b;
  }
  if (b == 3) {
  } else {
    t = r + s;
    r = t * 2;
  }
  bool both = a > 2 && b > 2, either = a > 5 || x > y, one = (a > 3) != (b > 3);
  if (!(both || either) && one) r += 100;
  int u = a > b ? (x > y ? 1 : 2) : (b > 4 ? 3 : 4);
  return ivec4(r, s, u, both ? 1 : either ? 2 : 3);
}
