// In place of exact/bilinear.glsl where OpenGL is timed: the driver's own filter, by the same names. Its weights are the driver's, so
// its bits are comparable to nothing. Samplers clamp to the edge.

struct ExactTaps {
  vec2 uv;
};

ExactTaps exact_taps_clamp(vec2 uv, ivec2 size) {
  return ExactTaps(uv);
}

vec4 exact_fetch(sampler2DArray maps, ExactTaps taps, int layer) {
  return texture(maps, vec3(taps.uv, float(layer)));
}

mat4 exact_fetch_4(sampler2DArray maps, ExactTaps taps, int first) {
  int last = textureSize(maps, 0).z - 1;
  return mat4(exact_fetch(maps, taps, first), exact_fetch(maps, taps, min(first + 1, last)),
              exact_fetch(maps, taps, min(first + 2, last)), exact_fetch(maps, taps, min(first + 3, last)));
}
