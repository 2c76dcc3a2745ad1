#version 450
layout(location = 0) flat in int a;
layout(location = 1) flat in int b;
struct Item { vec3 position; uint tag; mat2 frame; float spare[2]; };
layout(std430) readonly buffer Items { int offset; Item items[]; };
layout(std430) buffer Counters { uint total; uint seen[8]; int smallest; uint tail[]; };
layout(std140) buffer Grid { vec4 cells[]; } grid;
layout(location = 0) out vec4 answer;
layout(location = 1) out ivec4 numbers;
void main() {
  int row = a * 8 + b;
  Item item = items[(row + offset) % items.length()];
  answer = vec4(item.position.xy, item.frame[1].x, items[a].spare[b & 1]);
  numbers = ivec4(int(item.tag), items.length(), grid.cells.length(), int(tail.length()));
  if (b < 4) {
    grid.cells[row] = vec4(float(a), float(b), 3.0, 4.0);
    grid.cells[row].y += 0.5;
  }
  if (a == 7) { if (b == 7) discard; tail[b] = uint(row); }
  atomicAdd(total, 1u);
  uint before = atomicAdd(seen[a], uint(b));
  if (before > 1000u) answer.x = -1.0;
  atomicMin(smallest, b - a);
  tail[100 + row] = 1u;  // outside: dropped
}
