#version 450
layout(location = 0) flat in int a;
layout(location = 1) flat in int b;
struct Light { vec3 colour; float power; bool on; ivec2 range; };
uniform Light lights[3];
uniform mat3x2 tall;
uniform mat2 pair[2];
uniform float weights[5];
uniform uvec3 codes;
uniform bool enabled;
layout(std140) uniform Small { float first; vec3 second; float list[3]; mat3 m; layout(row_major) mat2x3 rows; } small_block;
layout(std140) uniform Large { vec4 rows_of[300]; };
layout(location = 0) out vec4 uniforms_out;
layout(location = 1) out vec4 block_out;
layout(location = 2) out vec4 large_out;
void main() {
  vec2 t = tall * vec3(1.0, 2.0, float(b));
  uniforms_out = vec4(lights[a % 3].colour.y + lights[1].power, t.x * 100.0 + t.y, weights[b % 5] + pair[a & 1][1][b & 1],
                      float(lights[b % 3].on ? lights[2].range.y : 0) + float(codes.z) + (enabled ? 0.5 : 0.25));
  vec2 r = small_block.second * small_block.rows;
  block_out = vec4(small_block.first + small_block.list[a % 3], small_block.m[1].z, small_block.m[b % 3][a % 3], r.x * 10.0 + r.y);
  large_out = rows_of[a * 8 + b] + rows_of[299];
}
