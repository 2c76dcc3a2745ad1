int uniform_switch(int b) {
  int r = 0;
  for (int k = 0; k < 6; k++) {
    switch (k) {
      case 0: r += 1;
      case 1: r += 10; break;
      case 4: r += 1000; if (b > 3) break; r += 5;
      default: r += 100;
      case 5: r ^= 3;
    }
  }
  return r;
}
int varying_switch(int a, int b) {
  int r = 0;
  switch (a) {
    case 0:
    case 1: r = 1;
    case 2:
      r += 10;
      if (b > 2) break;
      r += 5;
    default: r += 100; break;
    case 4:
      for (int i = 0; i < b; i++) { if (i == 3) break; r += i; }
      break;
    case 6: return -b;
    case 7: r = 7;
  }
  return r * 2 + b;
}
int nested(int a, int b) {
  int r = 0;
  for (int i = 0; i < 6; i++) {
    switch ((a + i) & 3) {
      case 0: continue;
      case 1:
        switch (b) {
          case 2: r += 1; break;
          case 3: r += 2;
          default: r += 4;
        }
        break;
      case 2: if (i > b) continue; r += 16; break;
      default: if (i == 5) return r + 1000;
    }
    r += 64;
  }
  return r;
}
ivec4 kernel(int a, int b, float x, float y) {
  uint u = uint(a);
  int w = 0;
  switch (u) { case 3u: w = 1; break; case 5u: w = 2; }
  return ivec4(uniform_switch(b), varying_switch(a, b), nested(a, b), w);
}
