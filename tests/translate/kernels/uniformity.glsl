// Values that start out the same in all lanes and must not stay so.
ivec4 kernel(int a, int b, float x, float y) {
  int u = 1;
  if (a > 3) u = 2;
  int last = 0;
  for (int i = 0; i < 6; i++) { last = i; if (i == b) break; }
  int count = 0;
  for (int i = 0; i < 6; i++) { if (i == a) continue; count++; }
  int v = 5, w = 5;
  for (int i = 0; i < 3; i++) {
    if (a == i) { v = i; w = 9; }
    else { w = 4; }
  }
  int s = 0;
  if (x > y) {
    int local = 3;
    for (int i = 0; i < 4; i++) local += i;
    s = local;
    u += local;
  }
  int late = 7;
  switch (b) { case 1: late = 1; break; case 2: late = 2; case 3: late += 10; }
  int n = 0, m = 0;
  while (n < 4) { n++; if (n == a) { m = n; break; } m = 10; }
  int through = 1;
  for (int i = 0; i < 3; i++) { if (i > 0) through *= 2; else through = a; }
  int step = 1, odd = 0;
  for (int i = 0; i < 12; i += step) { if ((i + a) % 3 == 0) continue; step = 3 - step; odd = odd * 2 + i; }
  int after = 0, j = 0;
  for (; j < 5; j++) { if (j == b) continue; if (j == 3) break; after = j; }
  through += step * 10 + odd % 50 + after * 100 + j;
  return ivec4(u * 100 + last, count * 100 + v * 10 + w, s * 1000 + late * 10 + n, m * 100 + through);
}
