// In place of sphere_map/taps.glsl where OpenGL is timed: the driver's own filter within a layer.

struct SphereMapTaps {
  vec2 uv;
  int layer;  // within the map
};

vec4 sphere_map_fetch(sampler2DArray array, SphereMapTaps taps, int maps, int map) {
  return texture(array, vec3(taps.uv, float(taps.layer * maps + map)));
}
