// Increments of loops that need variables of their own: elements that are passed, in the end of the head; or that move more
// than the counter, between constants.
void step(INOUT(int) x) { x += 1; }
void step_both(INOUT(int) x, INOUT(int) y) { x += 2; y += x; }
ivec4 kernel(int a, int b, float x, float y) {
  int numbers[2];
  numbers[0] = 0;
  numbers[1] = a;
  int sum = 0;
  for (int k = 0; numbers[0] < 5; step(numbers[0])) { sum += numbers[0] * b; k++; }
  for (int i = 0; i < b; step(numbers[1]), i++) { if (i == a) continue; sum += 3; }
  for (int i = a; i < 9; step_both(i, numbers[0])) { int again = i - 1; if (again > 7) continue; if (sum > 40 + b) break; sum += i; }
  int weight = 1;
  for (int i = 0; i < 4; ++i, weight *= 2) sum += weight * (i + b);
  for (int j = 9, i = 0; i < 3; ++i, --j) sum += i * j - a;
  for (int i = 0; i < 3; ++i) { for (int k = 5; k > 2; --k) sum += numbers[i & 1] * k; }
  return ivec4(numbers[0], numbers[1], sum, a);
}
