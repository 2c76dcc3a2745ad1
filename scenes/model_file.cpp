// From a model's parts to a scene: normals and tangents where they are missing, one vertex for equal corners, a
// lightmap where the second uvs can hold one, a camera that sees all of it.
#include "scenes/model_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>
#include <unordered_map>

#include "base/error.h"
#include "images/image_file.h"
#include "scenes/face_normals.h"
#include "scenes/gltf_model.h"
#include "scenes/lightmap_check.h"
#include "scenes/mikktspace.h"
#include "scenes/model_camera.h"
#include "scenes/model_part.h"
#include "scenes/obj_model.h"
#include "scenes/orthonormal_basis.h"
#include "scenes/patch_mesh.h"
#include "scenes/scene_limits.h"

namespace twinshade {
namespace {

using glm::dvec3;

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
double length_of(const glm::vec3& v) { return glm::length(dvec3(v)); }

// All vertex data of the corners of a part's triangles.
struct Corners {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs, lightmap_uvs;
};

class Assembly {
 public:
  Assembly(const std::string& path, Model model) : path_(path), model_(std::move(model)) {}

  Scene scene() {
    scene_.name = path_;
    scene_.files = std::move(model_.files);
    scene_.notes = std::move(model_.notes);
    scene_.images = std::move(model_.images);
    scene_.materials = model_.materials;
    has_lightmap_ = !model_.parts.empty();
    scene_.has_uvs = false;
    for (const ModelPart& part : model_.parts) {
      has_lightmap_ = has_lightmap_ && !part.lightmap_uvs.empty();
      some_lightmap_ = some_lightmap_ || !part.lightmap_uvs.empty();
      scene_.has_uvs = scene_.has_uvs || !part.uvs.empty();
    }
    for (const ModelPart& part : model_.parts) add(part);
    if (scene_.indices.empty()) throw UserError(path_ + ": has no triangles");
    const Bounds bounds = bounds_of(scene_.positions);
    if (glm::length(bounds.high - bounds.low) < kSmallestExtent)
      throw UserError(path_ + ": all its triangles lie within 1e-15 of one point; scale the model up");
    drop_unused_materials();
    check_colours();
    limit_colours();
    decide_lightmap();
    say(missing_normals_, missing_normals_ + ": no normals; made from the triangles");
    say(missing_uvs_,
        missing_uvs_ + ": no UVs; tangent frames come from the normals, images and normal maps are ignored");
    say(made_tangents_, "no tangents in the file: made by the MikkTSpace rules");
    scene_.camera_frames = !model_.camera;
    scene_.camera = model_.camera ? *model_.camera : framing_camera(bounds, 1);
    if (std::isinf(scene_.camera.far_plane)) scene_.camera.far_plane = far_plane_behind(bounds, scene_.camera);
    return std::move(scene_);
  }

 private:
  void say(const std::string& cause, const std::string& note) {
    if (!cause.empty()) scene_.notes.push_back(note);
  }

  void add(const ModelPart& part) {
    Corners corners;
    for (std::uint32_t i : part.indices) {
      const glm::vec3& p = part.positions[i];
      if (!finite(p))
        throw UserError(path_ + ": " + part.name + ": the position of vertex " + std::to_string(i) + " is not finite");
      if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) > kLargestCoordinate)
        throw UserError(path_ + ": " + part.name + ": vertex " + std::to_string(i) +
                        " lies farther than 1e15 from the origin; scale the model down");
      corners.positions.push_back(p);
      const bool uv_finite = part.uvs.empty() || (std::isfinite(part.uvs[i].x) && std::isfinite(part.uvs[i].y));
      if (!uv_finite)
        throw UserError(path_ + ": " + part.name + ": the UV of vertex " + std::to_string(i) + " is not finite");
      corners.uvs.push_back(part.uvs.empty() ? glm::vec2(0) : part.uvs[i]);
      if (has_lightmap_) corners.lightmap_uvs.push_back(part.lightmap_uvs[i]);
    }
    set_normals(part, corners);
    set_tangents(part, corners);
    append(corners, material_for(part));
  }

  void set_normals(const ModelPart& part, Corners& corners) {
    const std::size_t count = corners.positions.size();
    std::vector<bool> missing(count, part.normals.empty());
    corners.normals.resize(count);
    bool any = part.normals.empty();
    for (std::size_t i = 0; i < count && !part.normals.empty(); ++i) {
      const glm::vec3& n = part.normals[part.indices[i]];
      const double length = length_of(n);
      if (finite(n) && length > 1e-12)
        corners.normals[i] = glm::vec3(dvec3(n) / length);
      else
        any = missing[i] = true;
    }
    if (!any) return;
    if (missing_normals_.empty()) missing_normals_ = part.name;
    const std::vector<glm::vec3> made = face_normals(corners.positions, model_.cos_crease);
    for (std::size_t i = 0; i < count; ++i)
      if (missing[i]) corners.normals[i] = made[i];
  }

  void set_tangents(const ModelPart& part, Corners& corners) {
    const std::size_t count = corners.positions.size();
    if (part.uvs.empty()) {
      if (missing_uvs_.empty()) missing_uvs_ = part.name;
      for (const glm::vec3& n : corners.normals)
        corners.tangents.emplace_back(glm::vec3(orthonormal_tangent(dvec3(n))), 1.0f);
      return;
    }
    bool own = !part.tangents.empty();
    for (std::size_t i = 0; i < count && own; ++i) {
      const glm::vec3 t(part.tangents[part.indices[i]]);
      own = finite(t) && glm::length(glm::cross(dvec3(t), dvec3(corners.normals[i]))) > 1e-6;
    }
    if (!own) {
      made_tangents_ = part.name;
      corners.tangents = mikktspace_tangents(corners.positions, corners.normals, corners.uvs);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec4& t = part.tangents[part.indices[i]];
      const dvec3 n(corners.normals[i]), tangent(t);
      corners.tangents.push_back(tangent_frame(n, tangent, glm::cross(n, tangent) * double(t.w)));
    }
  }

  // Parts without uvs get a copy of their material without images.
  int material_for(const ModelPart& part) {
    const Material& material = model_.materials[std::size_t(part.material)];
    if (!part.uvs.empty() || (material.albedo_image < 0 && material.normal_image < 0)) return part.material;
    const auto [entry, fresh] = plain_.try_emplace(part.material, int(scene_.materials.size()));
    if (fresh) {
      scene_.materials.push_back(material);
      scene_.materials.back().albedo_image = scene_.materials.back().normal_image = -1;
    }
    return entry->second;
  }

  // Equal corners of one material become one vertex, in the order of first use.
  void append(const Corners& corners, int material) {
    using Key = std::array<std::uint32_t, 14>;
    struct Hash {
      std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0;
        for (std::uint32_t word : key) hash = (hash ^ word) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
        return std::size_t(hash);
      }
    };
    std::unordered_map<Key, std::uint32_t, Hash> known;
    for (std::size_t i = 0; i < corners.positions.size(); ++i) {
      const glm::vec2 lightmap = has_lightmap_ ? corners.lightmap_uvs[i] : glm::vec2(0);
      const std::array<float, 14> data = {corners.positions[i].x,
                                          corners.positions[i].y,
                                          corners.positions[i].z,
                                          corners.normals[i].x,
                                          corners.normals[i].y,
                                          corners.normals[i].z,
                                          corners.tangents[i].x,
                                          corners.tangents[i].y,
                                          corners.tangents[i].z,
                                          corners.tangents[i].w,
                                          corners.uvs[i].x,
                                          corners.uvs[i].y,
                                          lightmap.x,
                                          lightmap.y};
      const auto [entry, fresh] = known.try_emplace(std::bit_cast<Key>(data), std::uint32_t(scene_.positions.size()));
      if (fresh) {
        scene_.positions.push_back(corners.positions[i]);
        scene_.normals.push_back(corners.normals[i]);
        scene_.tangents.push_back(corners.tangents[i]);
        scene_.uvs.push_back(corners.uvs[i]);
        if (has_lightmap_) scene_.lightmap_uvs.push_back(lightmap);
      }
      scene_.indices.push_back(entry->second);
      if (i % 3 == 0) scene_.triangle_materials.push_back(std::uint32_t(material));
    }
  }

  void drop_unused_materials() {
    std::vector<int> number(scene_.materials.size(), -1);
    std::vector<Material> used;
    for (std::uint32_t& material : scene_.triangle_materials) {
      if (number[material] < 0) {
        number[material] = int(used.size());
        used.push_back(scene_.materials[material]);
      }
      material = std::uint32_t(number[material]);
    }
    scene_.materials = std::move(used);
  }

  void check_colours() const {
    for (const Material& material : scene_.materials)
      for (int c = 0; c < 3; ++c)
        if (!(material.albedo[c] >= 0 && std::isfinite(material.albedo[c])))
          throw UserError(path_ + ": material '" + material.name + "': its colour (" +
                          std::to_string(material.albedo.x) + ", " + std::to_string(material.albedo.y) + ", " +
                          std::to_string(material.albedo.z) + ") is negative or not finite");
  }

  // More than it receives no surface reflects: frames and bounces alike.
  void limit_colours() {
    bool limited = false;
    const auto limit = [&](float& value) {
      limited |= value > 1;
      value = std::min(value, 1.0f);
    };
    for (Material& material : scene_.materials) {
      for (int c = 0; c < 3; ++c) limit(material.albedo[c]);
      if (material.albedo_image < 0) continue;
      std::vector<float>& texels = scene_.images[std::size_t(material.albedo_image)].texels;
      for (std::size_t i = 0; i < texels.size(); ++i)
        if (i % 4 != 3) limit(texels[i]);
    }
    if (limited) scene_.notes.push_back("colours above 1 are drawn as 1: surfaces reflect no more than they receive");
  }

  void decide_lightmap() {
    std::string reason = some_lightmap_ ? "only some parts have second UVs" : "no second UVs";
    if (has_lightmap_) reason = lightmap_fault(scene_.positions, scene_.lightmap_uvs, scene_.indices);
    if (has_lightmap_ && reason.empty()) return;
    if (has_lightmap_) reason = "the second UVs cannot hold a lightmap (" + reason + ")";
    scene_.lightmap_uvs.clear();
    scene_.notes.push_back(reason + ": light is baked per vertex");
  }

  std::string path_;
  Model model_;
  Scene scene_;
  bool has_lightmap_ = false, some_lightmap_ = false;
  std::string missing_normals_, missing_uvs_, made_tangents_;  // the first part concerned
  std::unordered_map<int, int> plain_;
};

}  // namespace

void transform_part(ModelPart& part, const glm::dmat4& world) {
  const dvec3 x(world[0]), y(world[1]), z(world[2]);
  // Normals go by the inverse transpose; up to its length that is the matrix of cofactors, times the sign of the
  // determinant.
  const dvec3 cx = glm::cross(y, z), cy = glm::cross(z, x), cz = glm::cross(x, y);
  const double side = glm::dot(x, cx) < 0 ? -1 : 1;
  const auto unit = [](const dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
  };
  for (glm::vec3& p : part.positions)
    p = glm::vec3(((x * double(p.x) + y * double(p.y)) + z * double(p.z)) + dvec3(world[3]));
  for (glm::vec3& n : part.normals)
    n = glm::vec3(unit(((cx * double(n.x) + cy * double(n.y)) + cz * double(n.z)) * side));
  for (glm::vec4& t : part.tangents)
    t = glm::vec4(glm::vec3(unit((x * double(t.x) + y * double(t.y)) + z * double(t.z))), float(side) * t.w);
  if (side < 0)
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) std::swap(part.indices[i + 1], part.indices[i + 2]);
}

std::string model_file_ending(const std::string& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".gltf" || ending == ".glb" || ending == ".obj" ? ending : "";
}

Scene load_model_file(const std::string& path, bool needs_camera) {
  try {
    Model model = model_file_ending(path) == ".obj" ? read_obj_model(path) : read_gltf_model(path, needs_camera);
    return Assembly(path, std::move(model)).scene();
  } catch (const std::bad_alloc&) {
    throw UserError(path + ": there is not enough memory for this model and its pictures; make them smaller");
  }
}

}  // namespace twinshade
