// The only list of sphere maps (sphere_maps.def): parameterizations of the sphere by square layers of texels.
#pragma once

#include <span>
#include <string_view>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct SphereMapInfo {
  std::string_view name;
  std::string_view file;  // under shaders/sphere_map/
  int layers;
  std::string_view source;

  // Of what is made without a width being asked for. Octahedral maps have texels on all axes where their width is odd;
  // of an even one the normals along +-x and +-y, of floors and walls, read texels that look elsewhere: 1.9 degrees
  // away at 32, 3.7 where areas are equal.
  int usual_width() const { return layers == 1 ? 33 : 32; }
  bool has_axes(int width) const { return layers != 1 || width % 2 == 1; }
  // The next smaller width to try: half of it, 1 at least; of an odd one again odd, for the axes' sake.
  static int half(int width) { return width == 1 ? 1 : width / 2 | (width & 1); }
  int texels(int width) const { return layers * width * width; }
  // Its layers are the faces of an OpenGL cube map.
  bool is_cube() const { return layers == 6; }
};

std::span<const SphereMapInfo> sphere_maps();
// UserError with the nearest names where there is none.
const SphereMapInfo& find_sphere_map(std::string_view name);

// For the host: `in vec3 direction; in float width` to `out vec3 texel[4]; out vec4 weight`: the four texels that a
// direction reads (x, y, layer) and their weights.
ShaderSource sphere_map_taps_source(const SphereMapInfo& map);

// For the host: `in vec3 texel; in float width` to `out vec3 direction`: the unit direction of a texel's centre.
ShaderSource sphere_map_direction_source(const SphereMapInfo& map);

// For renderers: the fragment shader that reads a map, `uniform sampler2DArray maps`, in the direction that `uniform
// sampler2D directions` has at the pixel.
ShaderSource sphere_map_read_source(const SphereMapInfo& map);

// The same by the driver's own bilinear filter, outside the exact dialect. `maps` is one map: a samplerCube of faces
// (Wrap::repeat: filtered across edges, OpenGL only) where the map is a cube; else a sampler2DArray, linear.
ShaderSource sphere_map_driver_source(const SphereMapInfo& map);

}  // namespace twinshade
