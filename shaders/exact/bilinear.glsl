// Bilinear filtering written out over texelFetch: hardware filters differ in their weights, four fetches and these sums do not.
// Texel centres at (i + 0.5) / size, as GL has them. Every uv is defined, NaN and infinities included: indices stay in range.
//
// Addresses and weights (taps) depend on uv and size alone, so several layers or textures of one size share them.

struct ExactTaps {
  ivec4 texel;   // x0, y0, x1, y1
  vec4 weight;   // of (x0,y0), (x1,y0), (x0,y1), (x1,y1)
};

vec4 exact_bilinear_weights(vec2 fraction) {
  precise vec2 low = 1.0 - fraction;
  precise float w00 = low.x * low.y;
  precise float w10 = fraction.x * low.y;
  precise float w01 = low.x * fraction.y;
  precise float w11 = fraction.x * fraction.y;
  return vec4(w00, w10, w01, w11);
}

// Clamp to edge. NaN reads texel 0.
ExactTaps exact_taps_clamp(vec2 uv, ivec2 size) {
  precise vec2 extent = vec2(size);
  precise vec2 last = extent - 1.0;
  precise vec2 position = uv * extent - 0.5;
  precise float u = position.x > 0.0 ? position.x : 0.0;
  precise float v = position.y > 0.0 ? position.y : 0.0;
  u = u < last.x ? u : last.x;
  v = v < last.y ? v : last.y;
  ivec2 low = ivec2(int(u), int(v));
  ivec2 high = min(low + 1, size - 1);
  precise vec2 fraction = vec2(u, v) - vec2(low);
  ExactTaps taps;
  taps.texel = ivec4(low, high);
  taps.weight = exact_bilinear_weights(fraction);
  return taps;
}

// Repeat. NaN and infinities read between the last texel and the first.
ExactTaps exact_taps_repeat(vec2 uv, ivec2 size) {
  precise vec2 extent = vec2(size);
  precise vec2 wrapped = uv - floor(uv);
  precise vec2 position = wrapped * extent - 0.5;
  precise float u = position.x > -0.5 ? position.x : -0.5;
  precise float v = position.y > -0.5 ? position.y : -0.5;
  precise vec2 cell = floor(vec2(u, v));
  precise vec2 fraction = vec2(u, v) - cell;
  ivec2 low = ivec2(cell);
  ivec2 high = low + 1;
  ExactTaps taps;
  taps.texel = ivec4(low.x < 0 ? size.x - 1 : low.x, low.y < 0 ? size.y - 1 : low.y,
                     high.x < size.x ? high.x : 0, high.y < size.y ? high.y : 0);
  taps.weight = exact_bilinear_weights(fraction);
  return taps;
}

vec4 exact_fetch(sampler2D map, ExactTaps taps) {
  vec4 t00 = texelFetch(map, taps.texel.xy, 0);
  vec4 t10 = texelFetch(map, taps.texel.zy, 0);
  vec4 t01 = texelFetch(map, taps.texel.xw, 0);
  vec4 t11 = texelFetch(map, taps.texel.zw, 0);
  precise vec4 filtered = (t00 * taps.weight.x + t10 * taps.weight.y) + (t01 * taps.weight.z + t11 * taps.weight.w);
  return filtered;
}

// 0 <= layer < layers of the map.
vec4 exact_fetch(sampler2DArray maps, ExactTaps taps, int layer) {
  vec4 t00 = texelFetch(maps, ivec3(taps.texel.xy, layer), 0);
  vec4 t10 = texelFetch(maps, ivec3(taps.texel.zy, layer), 0);
  vec4 t01 = texelFetch(maps, ivec3(taps.texel.xw, layer), 0);
  vec4 t11 = texelFetch(maps, ivec3(taps.texel.zw, layer), 0);
  precise vec4 filtered = (t00 * taps.weight.x + t10 * taps.weight.y) + (t01 * taps.weight.z + t11 * taps.weight.w);
  return filtered;
}

// RGB of a layer: the sum of what two taps read. Past the last layer, the last one.
vec3 exact_fetch_sum(sampler2DArray maps, ExactTaps low, ExactTaps high, int layer) {
  int inside = min(layer, textureSize(maps, 0).z - 1);
  precise vec3 sum = exact_fetch(maps, low, inside).rgb + exact_fetch(maps, high, inside).rgb;
  return sum;
}

// The same of three layers.
void exact_fetch_ones(sampler2DArray maps, ExactTaps low, ExactTaps high, ivec3 layer, out vec3 ones[3]) {
  ones[0] = exact_fetch_sum(maps, low, high, layer.x);
  ones[1] = exact_fetch_sum(maps, low, high, layer.y);
  ones[2] = exact_fetch_sum(maps, low, high, layer.z);
}

// The same of three layers from first on, a column each.
mat3 exact_fetch_three(sampler2DArray maps, ExactTaps low, ExactTaps high, int first) {
  return mat3(exact_fetch_sum(maps, low, high, first), exact_fetch_sum(maps, low, high, first + 1),
              exact_fetch_sum(maps, low, high, first + 2));
}

// The same from first.x, first.y and first.z on.
void exact_fetch_threes(sampler2DArray maps, ExactTaps low, ExactTaps high, ivec3 first, out mat3 threes[3]) {
  threes[0] = exact_fetch_three(maps, low, high, first.x);
  threes[1] = exact_fetch_three(maps, low, high, first.y);
  threes[2] = exact_fetch_three(maps, low, high, first.z);
}

// The same layer of two arrays, a column each.
mat2x4 exact_fetch_pair(sampler2DArray first, sampler2DArray second, ExactTaps taps, int layer) {
  return mat2x4(exact_fetch(first, taps, layer), exact_fetch(second, taps, layer));
}

vec4 exact_bilinear_2d(sampler2D map, vec2 uv) {
  return exact_fetch(map, exact_taps_clamp(uv, textureSize(map, 0)));
}

vec4 exact_bilinear_2d_repeat(sampler2D map, vec2 uv) {
  return exact_fetch(map, exact_taps_repeat(uv, textureSize(map, 0)));
}

vec4 exact_bilinear_2d_array(sampler2DArray maps, vec2 uv, int layer) {
  return exact_fetch(maps, exact_taps_clamp(uv, textureSize(maps, 0).xy), layer);
}

vec4 exact_bilinear_2d_array_repeat(sampler2DArray maps, vec2 uv, int layer) {
  return exact_fetch(maps, exact_taps_repeat(uv, textureSize(maps, 0).xy), layer);
}
