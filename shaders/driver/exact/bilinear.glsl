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
