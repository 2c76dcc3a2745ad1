#include "scenes/scene.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/names.h"
#include "scenes/builtin_scenes.h"
#include "scenes/model_file.h"

namespace twinshade {
namespace {

template <class T>
void add_array(Sha256& hash, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  hash.add(&count, sizeof count);
  hash.add(values.data(), values.size() * sizeof(T));
}

template <class T>
void add_value(Sha256& hash, const T& value) {
  hash.add(&value, sizeof value);
}

}  // namespace

std::vector<std::string> scene_names() {
  return {"courtyard", "house", "spheres", "quad", "raster_torture", "raster_invalid"};
}

Scene load_scene(const std::string& name_or_path, std::uint32_t triangles, bool needs_camera) {
  if (name_or_path == "courtyard") return make_courtyard(triangles);
  if (name_or_path == "house") return make_house(triangles);
  if (name_or_path == "spheres") return make_spheres(triangles);
  if (name_or_path == "quad") return make_quad(triangles);
  if (name_or_path == "raster_torture") return make_raster_torture(triangles, false);
  if (name_or_path == "raster_invalid") return make_raster_torture(triangles, true);
  const std::string ending = model_file_ending(name_or_path);
  if (!ending.empty()) {
    if (triangles != 0)
      throw UserError(name_or_path + ": --triangles is for built-in scenes; a model is drawn as it is");
    return load_model_file(name_or_path, needs_camera);
  }
  if (std::filesystem::path(name_or_path).extension() == ".bundle") {
    read_file(name_or_path);  // says why it cannot be read; bundles that can be are told by their content
    throw UserError(name_or_path + ": is not a bundle; make one with `twinshade bake`");
  }
  if (name_or_path.find_first_of("/.") != std::string::npos)
    throw UserError(name_or_path + ": not a model: the name must end in .gltf, .glb or .obj");
  throw UserError(unknown_name_message("scene", name_or_path, scene_names()));
}

std::string scene_hash(const Scene& scene) {
  static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec2) == 8 && sizeof(glm::vec4) == 16);
  Sha256 hash;
  hash.add("twinshade scene 1");
  add_array(hash, scene.positions);
  add_array(hash, scene.normals);
  add_array(hash, scene.tangents);
  add_array(hash, scene.uvs);
  add_array(hash, scene.lightmap_uvs);
  add_array(hash, scene.indices);
  add_array(hash, scene.triangle_materials);
  add_array(hash, scene.clip_positions);
  for (const Material& material : scene.materials) {
    add_value(hash, material.albedo);
    add_value(hash, std::int32_t(material.albedo_image));
    add_value(hash, std::int32_t(material.normal_image));
  }
  for (const Image& image : scene.images) {
    add_value(hash, image.width);
    add_value(hash, image.height);
    add_array(hash, image.texels);
  }
  add_value(hash, scene.camera.eye);
  add_value(hash, scene.camera.target);
  add_value(hash, scene.camera.up);
  add_value(hash, scene.camera.vertical_fov_degrees);
  if (scene.camera.orthographic_height > 0) add_value(hash, scene.camera.orthographic_height);
  add_value(hash, scene.camera.near_plane);
  add_value(hash, scene.camera.far_plane);
  add_value(hash, std::uint8_t(scene.procedural_coefficients));
  add_value(hash, std::uint8_t(scene.has_uvs));
  return hash.hex();
}

}  // namespace twinshade
