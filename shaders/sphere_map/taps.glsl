// Four texels of a sphere map and their weights. A map is SPHERE_MAP_LAYERS layers of width x width texels; several maps lie one
// after the other in a texture array. Addresses depend on direction and width alone: maps of one kind and width share them.

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

// first_layer: of the map, a multiple of SPHERE_MAP_LAYERS.
vec4 sphere_map_fetch(sampler2DArray maps, SphereMapTaps taps, int first_layer) {
  vec4 t00 = texelFetch(maps, ivec3(taps.texel_00.xy, taps.texel_00.z + first_layer), 0);
  vec4 t10 = texelFetch(maps, ivec3(taps.texel_10.xy, taps.texel_10.z + first_layer), 0);
  vec4 t01 = texelFetch(maps, ivec3(taps.texel_01.xy, taps.texel_01.z + first_layer), 0);
  vec4 t11 = texelFetch(maps, ivec3(taps.texel_11.xy, taps.texel_11.z + first_layer), 0);
  precise vec4 filtered = (t00 * taps.weight.x + t10 * taps.weight.y) + (t01 * taps.weight.z + t11 * taps.weight.w);
  return filtered;
}
