// Names that mean something in C++ or in the generated file.
struct Shader { float N; int class_, F; };
int select(int signed_, int int_) { return signed_ + int_; }
int this_(int mask) { return mask; }
int doubled(OUT(int) mask3, int n) { mask3 = n * 2; return n; }
int K = 4;
ivec4 kernel(int a, int b, float x, float y) {
  int main_ = a, vec = b, kept = 2, B = 3, t1 = 4, mask1 = 5, result = 6;
  Shader Base;
  Base.N = x;
  Base.F = a;
  Base.class_ = b;
  for (int i = 0; i < 2; i++) { int i_ = i; main_ += i_; }
  for (int i = 0; i < 3; i++) { if (i == a) break; int lookup = i; vec += lookup; }
  if (a > b) { int a_ = 3; result += a_; mask1 += 1; }
  while (vec < a) vec += 2;
  vec += doubled(b, a);
  return ivec4(select(main_, vec), kept + B * 10 + t1 * 100 + mask1 * 1000, result + this_(K), Base.F + Base.class_ + int(Base.N));
}
