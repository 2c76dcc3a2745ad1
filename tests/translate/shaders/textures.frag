#version 450
layout(location = 0) flat in int a;
layout(location = 1) flat in int b;
uniform sampler2D single;
uniform sampler2DArray layered;
uniform sampler2D several[2];
uniform samplerCube around;
layout(location = 0) out vec4 fetched;
layout(location = 1) out vec4 sampled;
layout(location = 2) out ivec4 sizes;
vec4 corner(sampler2D map, ivec2 p) { return texelFetch(map, p, 0); }
float mean(sampler2DArray maps, int layer) {
  float sum = 0.0;
  for (int x = 0; x < 2; x++) sum += texelFetch(maps, ivec3(x, 1, layer), 0).r;
  return sum * 0.5;
}
void main() {
  fetched = vec4(texelFetch(single, ivec2(a & 3, b & 1), 0).g, corner(several[1], ivec2(b & 1, 0)).r, mean(layered, a % 3),
                 texelFetchOffset(single, ivec2(1, 0), 0, ivec2(1, 1)).r);
  vec2 uv = (vec2(a & 3, b & 1) + 0.5) / vec2(4.0, 2.0);
  sampled = vec4(texture(single, uv).r, textureLod(layered, vec3(0.75, 0.25, 2.0), 0.0).r, texture(several[0], vec2(0.1)).b,
                 texture(around, vec3(0.0, 0.0, a > 3 ? 1.0 : -1.0)).r);
  sizes = ivec4(textureSize(single, 0), textureSize(layered, 0).z, textureSize(several[0], 0).x + textureSize(around, 0).y * 10);
}
