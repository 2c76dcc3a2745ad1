const int primes[8] = {2, 3, 5, 7, 11, 13, 17, 19};
const float small[3] = {0.5f, 0.25f, 0.125f};
int big(int i) {
  const int t[40] = {0, 1, 4, 9, 16, 25, 36, 49, 64, 81, 100, 121, 144, 169, 196, 225, 256, 289, 324, 361,
                     400, 441, 484, 529, 576, 625, 676, 729, 784, 841, 900, 961, 1024, 1089, 1156, 1225, 1296, 1369, 1444, 1521};
  return t[i];
}
ivec4 kernel(int a, int b, float x, float y) {
  int s = 0;
  for (int i = 0; i < 8; i++) s += primes[i] * (i + a);
  int changing[8] = {2, 3, 5, 7, 11, 13, 17, 19};
  changing[a] = b;
  return ivec4(s, primes[a] + primes[7 - b] * 100, big(a * 5 + (b & 3)) + int(small[b % 3] * 800.0f), changing[b] + changing[a] * 100);
}
