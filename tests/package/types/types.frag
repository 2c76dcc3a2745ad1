// Every type that crosses the boundary, under names that C++ has other uses for.
#version 450
struct Light {
  vec3 colour;
  float power[2];
};
uniform Light lights[3];
uniform mat3x2 columns;
uniform int bias[2];
uniform bool negate;
uniform uint mask;
uniform sampler2D picture;
uniform sampler2DArray pictures[2];
layout(std140) uniform Scales {
  vec4 scale;
  float offsets[2];
};
in vec3 delete;
flat in ivec2 index;
flat in uint bits;
in mat2 turn;
in float Real[3];
layout(location = 0) out vec4 operator_;
layout(location = 1) out ivec2 sums;
layout(location = 2) out uint masked;

void main() {
  vec2 turned = turn * (columns * delete);
  float power = lights[index.x].power[1] * (negate ? -1.0 : 1.0);
  operator_.xy = turned + scale.xy * offsets[1];
  operator_.z = dot(lights[2].colour, vec3(1.0, 10.0, 100.0)) * power;
  operator_.w = texelFetch(picture, ivec2(1, 0), 0).y + texelFetch(pictures[1], ivec3(0, 0, 1), 0).x + Real[2];
  sums = index + ivec2(bias[0], bias[1]);
  masked = bits & mask;
}
