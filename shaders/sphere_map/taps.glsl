// Four texels of a sphere map and their weights. A map is SPHERE_MAP_LAYERS layers of width x width texels. Addresses depend on direction and width alone: maps of one kind and width share them.

struct SphereMapTaps {
  ivec3 texel_00, texel_10, texel_01, texel_11;  // x, y, layer within the map
  vec4 weight;                                    // in this order; their sum is 1
};

// Four texels of one layer: the corners low and high of a block.
SphereMapTaps sphere_map_block(ivec2 low, ivec2 high, int layer, vec4 weight) {
  SphereMapTaps taps;
  taps.texel_00 = ivec3(low, layer);
  taps.texel_10 = ivec3(high.x, low.y, layer);
  taps.texel_01 = ivec3(low.x, high.y, layer);
  taps.texel_11 = ivec3(high, layer);
  taps.weight = weight;
  return taps;
}

vec4 sphere_map_filter(vec4 t00, vec4 t10, vec4 t01, vec4 t11, vec4 weight) {
  precise vec4 filtered = (t00 * weight.x + t10 * weight.y) + (t01 * weight.z + t11 * weight.w);
  return filtered;
}

// From an array of `maps` maps, their layers interleaved: layer l of map m is layer l * maps + m, so that what is read together lies
// together.
vec4 sphere_map_fetch(sampler2DArray array, SphereMapTaps taps, int maps, int map) {
  vec4 t00 = texelFetch(array, ivec3(taps.texel_00.xy, taps.texel_00.z * maps + map), 0);
  vec4 t10 = texelFetch(array, ivec3(taps.texel_10.xy, taps.texel_10.z * maps + map), 0);
  vec4 t01 = texelFetch(array, ivec3(taps.texel_01.xy, taps.texel_01.z * maps + map), 0);
  vec4 t11 = texelFetch(array, ivec3(taps.texel_11.xy, taps.texel_11.z * maps + map), 0);
  return sphere_map_filter(t00, t10, t01, t11, taps.weight);
}

// The same from one ordinary texture of maps that are `width` texels wide: a map's layers side by side, one map above the other.
vec4 sphere_map_fetch(sampler2D maps, SphereMapTaps taps, int width, int map) {
  ivec2 corner = ivec2(0, map * width);
  vec4 t00 = texelFetch(maps, corner + ivec2(taps.texel_00.x + taps.texel_00.z * width, taps.texel_00.y), 0);
  vec4 t10 = texelFetch(maps, corner + ivec2(taps.texel_10.x + taps.texel_10.z * width, taps.texel_10.y), 0);
  vec4 t01 = texelFetch(maps, corner + ivec2(taps.texel_01.x + taps.texel_01.z * width, taps.texel_01.y), 0);
  vec4 t11 = texelFetch(maps, corner + ivec2(taps.texel_11.x + taps.texel_11.z * width, taps.texel_11.y), 0);
  return sphere_map_filter(t00, t10, t01, t11, taps.weight);
}
