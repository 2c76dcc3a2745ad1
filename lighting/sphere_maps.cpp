#include "lighting/sphere_maps.h"

#include <string>
#include <vector>

#include "base/error.h"
#include "base/names.h"

namespace twinshade {
namespace {

constexpr SphereMapInfo kMaps[] = {
#define SPHERE_MAP(name, file, layers, source) {#name, #file, layers, source},
#include "lighting/sphere_maps.def"
#undef SPHERE_MAP
};

}  // namespace

std::span<const SphereMapInfo> sphere_maps() { return kMaps; }

const SphereMapInfo& find_sphere_map(std::string_view name) {
  for (const SphereMapInfo& map : kMaps)
    if (map.name == name) return map;
  std::vector<std::string> names;
  for (const SphereMapInfo& map : kMaps) names.emplace_back(map.name);
  throw UserError(unknown_name_message("sphere map", std::string(name), names));
}

ShaderSource sphere_map_taps_source(const SphereMapInfo& map) {
  const std::string name = std::string(map.name) + "_taps";
  const std::string text = "#include \"sphere_map/" + std::string(map.file) +
                           "\"\n"
                           "in vec3 direction;\n"
                           "in float width;\n"
                           "out vec3 texel[4];\n"
                           "out vec4 weight;\n"
                           "void main() {\n"
                           "  SphereMapTaps taps = sphere_map_taps(direction, int(width));\n"
                           "  texel[0] = vec3(taps.texel_00);\n"
                           "  texel[1] = vec3(taps.texel_10);\n"
                           "  texel[2] = vec3(taps.texel_01);\n"
                           "  texel[3] = vec3(taps.texel_11);\n"
                           "  weight = taps.weight;\n"
                           "}\n";
  return resolve_shader(name, text, name);
}

ShaderSource sphere_map_direction_source(const SphereMapInfo& map) {
  const std::string name = std::string(map.name) + "_direction";
  const std::string text = "#include \"sphere_map/" + std::string(map.file) +
                           "\"\n"
                           "in vec3 texel;\n"
                           "in float width;\n"
                           "out vec3 direction;\n"
                           "void main() {\n"
                           "  direction = sphere_map_direction(ivec3(texel), int(width));\n"
                           "}\n";
  return resolve_shader(name, text, name);
}

ShaderSource sphere_map_read_source(const SphereMapInfo& map) {
  const std::string name = std::string(map.name) + "_read";
  const std::string text =
      "#include \"sphere_map/" + std::string(map.file) +
      "\"\n"
      "uniform sampler2D directions;\n"
      "uniform sampler2DArray maps;\n"
      "out vec4 color;\n"
      "void main() {\n"
      "  vec3 direction = texelFetch(directions, ivec2(gl_FragCoord.xy), 0).rgb;\n"
      "  color = sphere_map_fetch(maps, sphere_map_taps(direction, textureSize(maps, 0).x), 1, 0);\n"
      "}\n";
  return resolve_shader(name, text, name);
}

ShaderSource sphere_map_driver_source(const SphereMapInfo& map) {
  const std::string name = std::string(map.name) + "_driver";
  const std::string directions = "uniform sampler2D directions;\nout vec4 color;\n",
                    direction = "  vec3 direction = texelFetch(directions, ivec2(gl_FragCoord.xy), 0).rgb;\n";
  if (map.is_cube())
    return resolve_shader(name,
                          directions + "uniform samplerCube maps;\nvoid main() {\n" + direction +
                              "  color = textureLod(maps, direction, 0.0);\n}\n",
                          name);
  return resolve_shader(name,
                        "#include \"sphere_map/" + std::string(map.file) + "\"\n" + directions +
                            "uniform sampler2DArray maps;\n"
                            "void main() {\n" +
                            direction +
                            "  vec3 square = sphere_map_square(direction);\n"
                            "  float width = float(textureSize(maps, 0).x);\n"
                            "  vec2 place = (square.xy * (width - 1.0) + width) / (2.0 * width);\n"
                            "  color = textureLod(maps, vec3(place, square.z), 0.0);\n"
                            "}\n",
                        name);
}

}  // namespace twinshade
