struct Inner { int n; float w; };
struct Outer { Inner parts[3]; ivec2 tag; int list[4]; };
Inner make(int n, float w) { Inner i; i.n = n; i.w = w; return i; }
int total(Outer o) { int s = 0; for (int i = 0; i < 3; i++) s += o.parts[i].n; for (int i = 0; i < 4; i++) s += o.list[i]; return s; }
void touch(INOUT(Outer) o, int k) { if (k > 1) o.parts[k % 3].n += 100; o.list[k & 3] = k; }
ivec4 kernel(int a, int b, float x, float y) {
  Outer o;
  for (int i = 0; i < 3; i++) o.parts[i] = make(i + a, x * float(i));
  for (int i = 0; i < 4; i++) o.list[i] = i * b;
  o.tag = ivec2(a, b);
  Outer p = o;
  p.parts[a % 3].n = 50;
  p.parts[b % 3].w = y;
  if (a > b) p.parts[1] = o.parts[a & 1];
  touch(p, b);
  int grid[3][2];
  for (int i = 0; i < 3; i++) for (int j = 0; j < 2; j++) grid[i][j] = i * 10 + j;
  grid[a % 3][b & 1] += 7;
  if (x > y) grid[b % 3][a & 1] = -1;
  int g = 0;
  for (int i = 0; i < 3; i++) g = g * 3 + grid[i][(i + a) & 1];
  Outer q = a > 4 ? o : p;
  if (b == 2) o = q;
  float w = p.parts[a % 3].w + q.parts[b % 3].w;
  return ivec4(total(o) + 1000 * total(q), g, int(w * 16.0f), p.tag.x * 10 + q.tag.y);
}
