// In place of sphere_map/taps.glsl where OpenGL is timed: the driver's own filter within a layer.

struct SphereMapTaps {
  vec2 uv;
  int layer;  // within the map
};

vec4 sphere_map_fetch(sampler2DArray array, SphereMapTaps taps, int maps, int map) {
  return texture(array, vec3(taps.uv, float(taps.layer * maps + map)));
}

vec3[5] sphere_map_fetch_5(sampler2DArray array, SphereMapTaps taps, int maps, int five) {
  int first = five * 5;
  return vec3[5](sphere_map_fetch(array, taps, maps, first).rgb, sphere_map_fetch(array, taps, maps, first + 1).rgb,
                 sphere_map_fetch(array, taps, maps, first + 2).rgb, sphere_map_fetch(array, taps, maps, first + 3).rgb,
                 sphere_map_fetch(array, taps, maps, first + 4).rgb);
}
