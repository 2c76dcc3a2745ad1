// RGB of the first maps of an array, as sphere_map_fetch has it, at once. Includer defines SPHERE_MAP_COLORS, how many. After a
// sphere map.

void sphere_map_fetch_colors(sampler2DArray array, SphereMapTaps taps, int maps, out vec3 colors[SPHERE_MAP_COLORS]) {
  for (int map = 0; map < SPHERE_MAP_COLORS; ++map) colors[map] = sphere_map_fetch(array, taps, maps, map).rgb;
}
