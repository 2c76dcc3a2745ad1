// Uniforms of every type that the shader itself gives values.
#version 450
struct Inner {
  mat2x3 turn;
  bool on;
};
struct Light {
  vec3 colour;
  Inner inner[2];
  int count[2];
};
uniform float gain = 0.1;
uniform float tiny = 1.0e-41;
uniform float infinite = 1.0 / 0.0;
uniform int least = -2147483647 - 1;
uniform uint most = 4294967295u;
uniform bool flag = true;
uniform bvec2 flags = bvec2(false, true);
uniform vec3 tint[2] = vec3[2](vec3(1.0), vec3(2.0, 3.0, 4.0));
uniform float grid[2][2] = float[2][2](float[2](1.0, 2.0), float[2](3.0, 4.0));
uniform mat3x2 columns = mat3x2(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
const Inner off = Inner(mat2x3(0.0), false);
uniform Light solo = Light(vec3(7.0, 8.0, 9.0), Inner[2](off, Inner(mat2x3(1.0), true)), int[2](-1, -2));
uniform Light lights[2] = Light[2](Light(vec3(0.0), Inner[2](off, off), int[2](0, 3)),
                                   Light(vec3(10.0, 11.0, 12.0), Inner[2](Inner(mat2x3(2.0), true), off), int[2](4, 5)));
uniform float unset;
out vec4 sums;

void main() {
  sums.x = gain + tiny + infinite + unset;
  sums.y = (flag ? 1.0 : 0.0) + (flags.x ? 10.0 : 0.0) + (flags.y ? 100.0 : 0.0) + float(least + int(most >> 1));
  sums.z = tint[1].z + grid[1][0] + columns[2].y;
  sums.w = solo.colour.z + solo.inner[1].turn[1].y + lights[1].inner[0].turn[0].x + float(lights[1].count[1]);
}
