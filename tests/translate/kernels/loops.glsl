ivec4 kernel(int a, int b, float x, float y) {
  int sum = 0, steps = 0;
  for (int i = 0; i < 5; i++) sum += i * a;
  for (int i = a; i > 0; --i) {
    for (int j = 0; j < b; j++) {
      sum += i * j;
      ++steps;
    }
  }
  float f = x;
  while (f < 8.0f) {
    f = f * 2.0f + 0.5f;
    steps += 3;
    if (steps > 60) break;
  }
  int n = a;
  do {
    n = n * 2 + 1;
    sum ^= n;
  } while (n < 50);
  int last = 0;
  for (int i = 0; i < 10; i++) {
    if (i == b) break;
    last = i;
  }
  int found = -1;
  for (int k = 0; ; k++) {
    if (k * k >= a + b) { found = k; break; }
  }
  return ivec4(sum, steps, last * 1000 + found, n);
}
