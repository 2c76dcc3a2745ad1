// Input blocks and structs, functions of two results, initialised uniforms, arrays of blocks, texture forms, loops that only
// a jump ends, names that are macros in C.
#version 450
in Surface { vec2 uv; flat int a; flat int b; } surface[2];
in Loose { float scale; };
struct Probe { vec3 at; float weights[2]; };
in Probe probe;
in float grid[2][3];
centroid in float edge;

uniform float gain = 2.5;
uniform mat2 turn = mat2(1.0, 2.0, 3.0, 4.0);
struct Pair { int first; vec2 second[2]; };
uniform Pair pair = Pair(-7, vec2[2](vec2(1.0, 2.0), vec2(3.0, 4.0)));
layout(std140) uniform Tint { vec4 value; } tints[2];
layout(std430) buffer Sums { uint total; uint list[]; } sums[2];
uniform int which = 1;
uniform sampler2D map;
uniform sampler2D nested[2][2];

layout(location = 0) out vec4 inputs_out;
layout(location = 1) out vec4 split;
layout(location = 2) out uvec4 wide;
layout(location = 3) out vec4 defaults;
layout(location = 4) out vec4 gathered;
layout(location = 5) out vec4 forms;
layout(location = 6) out vec4 edges;
layout(location = 7) out vec4 truths;
layout(location = 8) out vec4 loops;
layout(location = 9) out vec4 macros;

struct Hit { int EOF; float errno; };
const float FLT_MAX = 0.5;

// All of these give n + 1.
int end_while(int n) {
  int k = 0;
  float sign = 1.0;
  while (true) {
    if (++k > n) break;
    sign = -sign;
  }
  return k;
}
int end_for(int n) {
  int k = 0;
  for (; 1 < 2;)
    if (++k > n) return k;
}
int end_do(int n) {
  int k = 0;
  do {
    if (++k > n) break;
  } while (true);
  return k;
}
int end_do_after(int n) {
  const bool always = true;
  int k = 0;
  do {
    if (k++ == 2) continue;
    if (k > n) break;
  } while (always);
  return k;
}

void main() {
  int a = surface[0].a, b = surface[1].b;
  Probe copy = probe;
  inputs_out = vec4(surface[1].uv.y, scale + copy.weights[b & 1], probe.at.z, grid[1][2] + grid[a & 1][b % 3] + edge);

  ivec2 exponent;
  vec2 part = frexp(vec2(surface[0].uv.x, 0.375), exponent);
  split = vec4(part.x, float(exponent.x), ldexp(part.x, exponent.x), float(exponent.y));
  uint carry, borrow, high, low;
  uint sum = uaddCarry(4294967290u, uint(a), carry);
  uint difference = usubBorrow(uint(a), uint(b), borrow);
  umulExtended(uint(a) + 0x80000000u, 6u, high, low);
  wide = uvec4(sum + carry * 1000u, difference + borrow, high, low);
  if (a > 3) {
    int top, bottom;
    imulExtended(-a, b, top, bottom);
    wide.x = uint(top), wide.y = uint(bottom);
  }

  defaults = vec4(gain, turn[1].x, float(pair.first) + pair.second[b & 1].y, tints[which].value.x + tints[0].value.y);
  if (a == 2) sums[1].list[b] = uint(b) + 100u;
  atomicAdd(sums[which].total, 1u);

  vec2 middle = vec2(2.0, 1.0) / vec2(4.0, 2.0);  // of a map of 4 x 2: between texels
  loops = vec4(end_while(which), end_for(which), end_do(which), end_do_after(which)) +
          10.0 * vec4(end_while(a), end_for(a), end_do(a), end_do_after(3 + a));
  float stdin = FLT_MAX, M_PI = float(a);
  Hit hit = Hit(which, stdin + M_PI);
  int INT_MAX = hit.EOF, uniform_vec2 = 1;
  {
    int INT_MAX = uniform_vec2 + 1, uniform_vec2 = 3;
    hit.EOF = INT_MAX + uniform_vec2 - 4;
  }
  macros = vec4(hit.errno, hit.EOF, INT_MAX + uniform_vec2, stdin);

  gathered = textureGather(map, middle, 1) + 1000.0 * textureGatherOffset(map, middle, ivec2(-1, 0));
  truths = vec4(bvec2(ivec2(a, b & 1)), bvec2(uvec2(a & 2, b)));
  edges = textureGather(map, vec2(0.0), 1) + 1000.0 * textureGather(map, vec2(1.0), 1);
  vec2 first = vec2(0.5) / vec2(4.0, 2.0);
  forms = vec4(textureOffset(map, first, ivec2(2, 1)).r, textureProj(map, vec3(first * 4.0, 4.0)).r,
               texture(nested[1][which], first).r, float(textureQueryLevels(map)) + textureGrad(map, first, first, first).g);
}
