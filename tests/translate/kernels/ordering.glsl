int log_of_calls = 0;
int noted(int v) { log_of_calls = log_of_calls * 3 + v; return v; }
ivec4 kernel(int a, int b, float x, float y) {
  int i = a, r = 0;
  int old = i++;
  r = i + old * 10;
  int t[4] = {1, 2, 3, 4};
  int k = 0;
  t[k] = b;
  k++;
  t[k] = t[k - 1] + t[k];
  int before = t[1];
  t[1] = 100;
  int sum = before + t[1];
  int n1 = noted(1);
  int n2 = noted(2);
  int z = log_of_calls;
  int n3 = a > b ? noted(a) : noted(b);
  z = z * 100 + log_of_calls;
  bool skip = a > 3 && noted(4) > 0;
  bool skip2 = b > 3 || noted(5) > 9;
  int self = a + n1 + n2;
  int pre = ++i;
  i -= pre--;
  return ivec4(r + sum * 100, z, log_of_calls + (skip ? 1 : 0) + (skip2 ? 2 : 0), n3 + i + pre + self);
}
