ivec4 kernel(int a, int b, float x, float y) {
  int sum = 0, skipped = 0, i;
  for (i = 0; i < 8; i++) {
    if (i == a) continue;
    if (i > b + 2) break;
    if (x > y) {
      if ((i & 1) == 1) { skipped++; continue; }
      sum += 100;
    } else {
      if (i == 6) break;
    }
    sum += i;
  }
  int kept = 0, j = 0;
  while (true) {
    j++;
    if (j > 20) break;
    if ((j + a) % 3 == 0) continue;
    kept += j;
    if (kept > 40 + b) break;
    int inner = 0;
    do {
      inner++;
      if (inner == b) continue;
      if (inner == 6) break;
      kept++;
    } while (inner < a);
  }
  return ivec4(sum, skipped, i, kept * 100 + j);
}
