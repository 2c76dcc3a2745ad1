// Arrays and structures that are passed, and written under another name while the callee reads its own.
#version 450
struct Pair { int first; int second; };
layout(location = 0) flat in int a;
layout(location = 1) flat in int b;
layout(location = 0) out ivec4 answer;
layout(location = 1) out ivec2 list[2];
Pair pair;
int numbers[2];
int after_write(in int given[2]) {
  numbers[0] = 50;
  return given[0];
}
void write_all() {
  numbers[0] = 70;
  numbers[1] = 80;
}
int after_call(int given[2]) {
  write_all();
  return given[0] + given[1] * 100;
}
int passed_on(int given[2]) { return after_call(given); }
void exchange(const in Pair given) {
  pair.first = given.second;
  pair.second = given.first;
}
int copied_back(inout int given[2]) {
  numbers[0] = 7;
  given[1] = given[0] + 1;
  return numbers[0] + numbers[1] * 10;
}
ivec2 of_outputs(ivec2 given[2]) {
  list[0] = ivec2(1000);
  return given[0] + given[1];
}
void main() {
  numbers[0] = a, numbers[1] = b;
  int first = after_write(numbers) + numbers[0];
  numbers[0] = a, numbers[1] = b;
  int second = passed_on(numbers);
  numbers[0] = a, numbers[1] = b;
  int third = copied_back(numbers) + numbers[0] * 1000 + numbers[1] * 10000;
  pair = Pair(a, b);
  if (a != 3) exchange(pair);
  answer = ivec4(first, second, third, pair.first * 10 + pair.second);
  list[0] = ivec2(a, b), list[1] = ivec2(b, 2);
  ivec2 sum = of_outputs(list);
  list[1] = sum;
}
