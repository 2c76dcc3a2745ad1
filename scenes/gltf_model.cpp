// Khronos Group, glTF 2.0 specification (ISO/IEC 12113:2022), sections 3.5 (scenes), 3.7 (meshes, skins), 3.9
// (materials); KHR_texture_transform; EXT_mesh_gpu_instancing; KHR_materials_pbrSpecularGlossiness.
#include "scenes/gltf_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/portable_math.h"
#include "scenes/gltf_camera.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_ignored.h"
#include "scenes/material_image.h"
#include "scenes/read_for_model.h"

namespace twinshade {
namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using nlohmann::json;

// Vertices and corners of a mesh times its instances: a small file may claim any number.
constexpr std::size_t kMostInstanced = std::size_t(1) << 27;

// How a texture is looked up: which uv set, moved by KHR_texture_transform.
struct Lookup {
  int texture = -1;
  int uv_set = 0;
  double offset_x = 0, offset_y = 0, rotation = 0, scale_x = 1, scale_y = 1;

  bool same_place(const Lookup& other) const {
    return std::array{double(uv_set), offset_x, offset_y, rotation, scale_x, scale_y} ==
           std::array{double(other.uv_set), other.offset_x, other.offset_y,
                      other.rotation,       other.scale_x,  other.scale_y};
  }
};

class Reader {
 public:
  Reader(const std::string& path, bool needs_camera) : document_(path), needs_camera_(needs_camera) {}

  Model read() {
    try {
      read_all();
    } catch (const json::exception& error) {
      document_.fail_damaged(error);
    }
    return std::move(model_);
  }

 private:
  void read_all() {
    model_.files = document_.files();
    find_world_transforms();
    for (std::size_t node : order_) {
      if (document_.element("nodes", node).contains("mesh")) read_mesh_node(node);
      if (document_.element("nodes", node).contains("camera")) read_camera(node);
    }
    note_ignored_parts(document_, notes_);
    for (const std::string& note : notes_) model_.notes.push_back(note);
  }

  // Depth first through the default scene.
  void find_world_transforms() {
    std::vector<std::size_t> roots;
    if (document_.count("scenes") > 0) {
      for (const json& node : list(document_.element("scenes", document_.default_scene()), "nodes"))
        roots.push_back(gltf_integer(node));
    } else {
      std::set<std::size_t> children;
      for (std::size_t i = 0; i < document_.count("nodes"); ++i)
        for (const json& child : list(document_.element("nodes", i), "children")) children.insert(gltf_integer(child));
      for (std::size_t i = 0; i < document_.count("nodes"); ++i)
        if (!children.count(i)) roots.push_back(i);
      if (roots.empty() && document_.count("nodes") > 0)
        document_.fail("damaged: every node is a child of another, so their tree has no root");
    }
    world_.assign(document_.count("nodes"), dmat4(1));
    std::vector<bool> seen(document_.count("nodes"));
    std::vector<std::pair<std::size_t, dmat4>> pending;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, dmat4(1)});
    while (!pending.empty()) {
      const auto [index, parent] = pending.back();
      pending.pop_back();
      const json& node = document_.element("nodes", index);
      if (seen[index])
        document_.fail("damaged: node " + std::to_string(index) + " has two parents, or is its own ancestor");
      seen[index] = true;
      world_[index] = parent * local_transform(node);
      order_.push_back(index);
      const json& children = list(node, "children");
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        pending.push_back({gltf_integer(*child), world_[index]});
    }
  }

  // What a key, which may be missing, holds: of the type of `none`, which stands for it then.
  static const json& part_of(const json& object, const char* key, const json& none) {
    const auto found = object.find(key);
    if (found == object.end()) return none;
    if (found->type() != none.type())
      throw json::type_error::create(302, std::string("type must be ") + none.type_name(), &*found);
    return *found;
  }
  static const json& list(const json& object, const char* key) {
    static const json none = json::array();
    return part_of(object, key, none);
  }

  static dmat4 local_transform(const json& node) {
    if (node.contains("matrix")) {
      const auto m = node["matrix"].get<std::array<double, 16>>();
      dmat4 result;
      for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) result[c][r] = m[std::size_t(4 * c + r)];
      return result;
    }
    return scaled_turned_moved(node.value("scale", std::array<double, 3>{1, 1, 1}),
                               node.value("rotation", std::array<double, 4>{0, 0, 0, 1}),
                               node.value("translation", std::array<double, 3>{0, 0, 0}));
  }

  static dmat4 scaled_turned_moved(const std::array<double, 3>& s, std::array<double, 4> q,
                                   const std::array<double, 3>& t) {
    const double length = std::sqrt(((q[0] * q[0] + q[1] * q[1]) + q[2] * q[2]) + q[3] * q[3]);
    if (length > 0)
      for (double& component : q) component /= length;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    dmat4 result(1);
    result[0] = s[0] * dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0);
    result[1] = s[1] * dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0);
    result[2] = s[2] * dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0);
    result[3] = dvec4(t[0], t[1], t[2], 1);
    return result;
  }

  void read_mesh_node(std::size_t index) {
    const json& node = document_.element("nodes", index);
    const auto mesh_index = gltf_integer(node["mesh"]);
    const json& mesh = document_.element("meshes", mesh_index);
    const json& primitives = mesh.at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const json& primitive = primitives[p];
      ModelPart part;
      part.name = "mesh " + std::to_string(mesh_index) + " '" + mesh.value("name", "") + "'";
      if (primitives.size() > 1) part.name += " part " + std::to_string(p);
      const auto mode = primitive.contains("mode") ? gltf_integer(primitive["mode"]) : 4;
      if (mode < 4 || mode > 6) {
        notes_.insert("points and lines are not drawn");
        continue;
      }
      const json& attributes = primitive.at("attributes");
      if (!attributes.contains("POSITION")) continue;
      const int material = gltf_index(primitive, "material");
      const Lookup lookup = use_material(material, part);
      read_attributes(part, attributes, lookup);
      read_triangles(part, primitive, mode);
      morph(part, list(primitive, "targets"), list(node, "weights").empty() ? list(mesh, "weights") : node["weights"]);
      if (node.contains("skin") && attributes.contains("JOINTS_0") && attributes.contains("WEIGHTS_0")) {
        apply_skin(part, attributes, gltf_integer(node["skin"]));
        model_.parts.push_back(std::move(part));
        continue;
      }
      for (const dmat4& instance : instances(index, part)) {
        model_.parts.push_back(part);
        transform_part(model_.parts.back(), world_[index] * instance);
      }
    }
  }

  // Where a node's mesh stands within the node: once, or as often as EXT_mesh_gpu_instancing says.
  std::vector<dmat4> instances(std::size_t index, const ModelPart& part) {
    static const json none = json::object();
    const json& extensions = part_of(document_.element("nodes", index), "extensions", none);
    const auto found = extensions.find("EXT_mesh_gpu_instancing");
    if (found == extensions.end()) return {dmat4(1)};
    const json& attributes = found->at("attributes");
    std::size_t count = 0;
    const auto read = [&](const char* name, std::uint32_t components) {
      if (!attributes.contains(name)) return GltfDocument::Numbers{};
      GltfDocument::Numbers numbers = document_.numbers(gltf_integer(attributes[name]));
      if (numbers.components != components || (count > 0 && numbers.count() != count))
        document_.fail("damaged: node " + std::to_string(index) + "'s instances have " +
                       std::to_string(numbers.count()) + " times " + std::to_string(numbers.components) +
                       " numbers of " + name);
      count = numbers.count();
      return numbers;
    };
    const auto moves = read("TRANSLATION", 3), turns = read("ROTATION", 4), scales = read("SCALE", 3);
    if (count * (part.positions.size() + part.indices.size()) > kMostInstanced)
      document_.fail("not supported: node " + std::to_string(index) + " has " + std::to_string(count) +
                     " instances of a mesh of " + std::to_string(part.positions.size()) + " vertices");
    std::vector<dmat4> result;
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 3> scale{1, 1, 1}, move{};
      std::array<double, 4> turn{0, 0, 0, 1};
      if (!scales.values.empty()) std::copy_n(&scales.values[3 * i], 3, scale.begin());
      if (!turns.values.empty()) std::copy_n(&turns.values[4 * i], 4, turn.begin());
      if (!moves.values.empty()) std::copy_n(&moves.values[3 * i], 3, move.begin());
      result.push_back(scaled_turned_moved(scale, turn, move));
    }
    return result;
  }

  // Adds the targets by the weights that they have at rest (3.7.2.2).
  void morph(ModelPart& part, const json& targets, const json& weights) {
    for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
      const auto weight = weights[t].get<double>();
      const auto add = [&](const char* name, auto& to) {
        if (weight == 0 || to.empty() || !targets[t].contains(name)) return;
        const auto by = attribute(part, targets[t], name, 3);
        for (std::size_t i = 0; i < by.count(); ++i)
          for (int c = 0; c < 3; ++c) to[i][c] = float(to[i][c] + weight * by.values[3 * i + std::size_t(c)]);
      };
      add("POSITION", part.positions);
      add("NORMAL", part.normals);
      add("TANGENT", part.tangents);
    }
  }

  GltfDocument::Numbers attribute(const ModelPart& part, const json& attributes, const char* name,
                                  std::uint32_t components) {
    GltfDocument::Numbers numbers = document_.numbers(gltf_integer(attributes.at(name)));
    if (numbers.components != components && !(components == 4 && numbers.components == 3))
      document_.fail("damaged: " + part.name + " has " + name + " of " + std::to_string(numbers.components) +
                     " components");
    if (!part.positions.empty() && numbers.count() != part.positions.size())
      document_.fail("damaged: " + part.name + " has " + std::to_string(part.positions.size()) + " positions but " +
                     std::to_string(numbers.count()) + " of " + name);
    return numbers;
  }

  void read_attributes(ModelPart& part, const json& attributes, const Lookup& lookup) {
    const auto positions = attribute(part, attributes, "POSITION", 3);
    for (std::size_t i = 0; i < positions.count(); ++i)
      part.positions.emplace_back(positions.values[3 * i], positions.values[3 * i + 1], positions.values[3 * i + 2]);
    if (attributes.contains("NORMAL")) {
      const auto normals = attribute(part, attributes, "NORMAL", 3);
      for (std::size_t i = 0; i < normals.count(); ++i)
        part.normals.emplace_back(normals.values[3 * i], normals.values[3 * i + 1], normals.values[3 * i + 2]);
    }
    // A file's tangents belong to the normal map's uvs, whichever those are (3.7.2.1).
    if (attributes.contains("TANGENT") && attributes.contains("NORMAL")) {
      const auto tangents = attribute(part, attributes, "TANGENT", 4);
      for (std::size_t i = 0; i < tangents.count() && tangents.components == 4; ++i) {
        const float* v = &tangents.values[4 * i];
        part.tangents.emplace_back(v[0], v[1], v[2], v[3] < 0 ? -1.0f : 1.0f);
      }
    }
    const std::string set = "TEXCOORD_" + std::to_string(lookup.uv_set);
    if (attributes.contains(set)) {
      const auto uvs = attribute(part, attributes, set.c_str(), 2);
      const double c = portable::cos(lookup.rotation), s = portable::sin(lookup.rotation);
      const bool moved = !lookup.same_place(Lookup{}) && lookup.texture >= 0;
      for (std::size_t i = 0; i < uvs.count(); ++i) {
        double u = uvs.values[2 * i], v = uvs.values[2 * i + 1];
        if (moved) {
          const double su = u * lookup.scale_x, sv = v * lookup.scale_y;
          u = (c * su + s * sv) + lookup.offset_x;
          v = (c * sv - s * su) + lookup.offset_y;
        }
        part.uvs.emplace_back(u, 1 - v);  // glTF's v points down
      }
    }
    if (attributes.contains("TEXCOORD_1")) {
      const auto uvs = attribute(part, attributes, "TEXCOORD_1", 2);
      for (std::size_t i = 0; i < uvs.count(); ++i)
        part.lightmap_uvs.emplace_back(uvs.values[2 * i], 1 - double(uvs.values[2 * i + 1]));
    }
    if (attributes.contains("COLOR_0")) notes_.insert("vertex colours are ignored");
  }

  void read_triangles(ModelPart& part, const json& primitive, std::uint64_t mode) {
    std::vector<std::uint32_t> list;
    if (primitive.contains("indices")) {
      list = document_.integers(gltf_integer(primitive["indices"]));
    } else {
      for (std::uint32_t i = 0; i < part.positions.size(); ++i) list.push_back(i);
    }
    for (std::uint32_t i : list)
      if (i >= part.positions.size())
        document_.fail("damaged: " + part.name + " has " + std::to_string(part.positions.size()) +
                       " vertices, but the index " + std::to_string(i));
    if (mode == 4) {
      list.resize(list.size() / 3 * 3);
      part.indices = std::move(list);
      return;
    }
    for (std::size_t i = 2; i < list.size(); ++i) {
      if (mode == 6)
        part.indices.insert(part.indices.end(), {list[0], list[i - 1], list[i]});
      else if (i % 2 == 0)
        part.indices.insert(part.indices.end(), {list[i - 2], list[i - 1], list[i]});
      else
        part.indices.insert(part.indices.end(), {list[i - 1], list[i - 2], list[i]});
    }
  }

  // Vertices follow their joints as the file leaves them; the node's own transform does not count (3.7.3.3).
  void apply_skin(ModelPart& part, const json& attributes, std::size_t skin_index) {
    const json& skin = document_.element("skins", skin_index);
    std::vector<std::size_t> joints;
    for (const json& joint : list(skin, "joints")) joints.push_back(gltf_integer(joint));
    std::vector<dmat4> matrices;
    GltfDocument::Numbers inverse_bind;
    if (skin.contains("inverseBindMatrices"))
      inverse_bind = document_.numbers(gltf_integer(skin["inverseBindMatrices"]));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j] >= world_.size())
        document_.fail("damaged: skin " + std::to_string(skin_index) + " has no joint " + std::to_string(j));
      dmat4 bind(1);
      if (inverse_bind.components == 16 && j < inverse_bind.count())
        for (int k = 0; k < 16; ++k) bind[k / 4][k % 4] = inverse_bind.values[16 * j + std::size_t(k)];
      matrices.push_back(world_[joints[j]] * bind);
    }
    std::vector<dmat4> sums(part.positions.size(), dmat4(0));
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {  // four joints a vertex
      const std::string name = "WEIGHTS_" + std::to_string(set);
      const auto which = document_.integers(gltf_integer(attributes.at("JOINTS_" + std::to_string(set))));
      const auto weights = attribute(part, attributes, name.c_str(), 4);
      if (weights.components != 4 || which.size() != weights.values.size())
        document_.fail("damaged: " + part.name + " has joints without weights");
      for (std::size_t k = 0; k < which.size(); ++k) {
        if (weights.values[k] == 0) continue;
        if (which[k] >= matrices.size())
          document_.fail("damaged: " + part.name + " follows joint " + std::to_string(which[k]));
        sums[k / 4] += double(weights.values[k]) * matrices[which[k]];
      }
    }
    std::vector<bool> mirrored(part.positions.size());
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
      const dmat4& sum = sums[i];
      mirrored[i] = glm::determinant(glm::dmat3(sum)) < 0;
      ModelPart vertex;
      vertex.positions = {part.positions[i]};
      if (!part.normals.empty()) vertex.normals = {part.normals[i]};
      if (!part.tangents.empty()) vertex.tangents = {part.tangents[i]};
      transform_part(vertex, sum);
      part.positions[i] = vertex.positions[0];
      if (!part.normals.empty()) part.normals[i] = vertex.normals[0];
      if (!part.tangents.empty()) part.tangents[i] = vertex.tangents[0];
    }
    // As a node's transform that mirrors turns triangles round, else their front would be another than their normals'.
    for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3)
      if (mirrored[part.indices[t]] && mirrored[part.indices[t + 1]] && mirrored[part.indices[t + 2]])
        std::swap(part.indices[t + 1], part.indices[t + 2]);
  }

  Lookup read_lookup(const json& owner, const char* key) {
    Lookup lookup;
    const auto found = owner.find(key);
    if (found == owner.end()) return lookup;
    lookup.texture = gltf_index(*found, "index");
    lookup.uv_set = std::max(0, gltf_index(*found, "texCoord"));
    if (const auto extensions = found->find("extensions"); extensions != found->end())
      if (const auto transform = extensions->find("KHR_texture_transform"); transform != extensions->end()) {
        const auto offset = transform->value("offset", std::array<double, 2>{0, 0});
        const auto scale = transform->value("scale", std::array<double, 2>{1, 1});
        lookup.offset_x = offset[0], lookup.offset_y = offset[1];
        lookup.scale_x = scale[0], lookup.scale_y = scale[1];
        lookup.rotation = gltf_number(*transform, "rotation", 0);
        if (transform->contains("texCoord")) lookup.uv_set = std::max(0, gltf_index(*transform, "texCoord"));
      }
    if (const auto texture = lookup.texture; texture >= 0) {
      const int sampler = gltf_index(document_.element("textures", std::size_t(texture)), "sampler");
      if (sampler >= 0) {
        const json& object = document_.element("samplers", std::size_t(sampler));
        if (gltf_number(object, "magFilter", 9729) == 9728)
          notes_.insert("textures of nearest texels are filtered bilinearly");
        if (gltf_number(object, "wrapS", 10497) != 10497 || gltf_number(object, "wrapT", 10497) != 10497)
          notes_.insert("textures that clamp or mirror at their edges are repeated instead");
      }
    }
    return lookup;
  }

  // The part's material, added to the model on first use; how its images are looked up.
  Lookup use_material(int index, ModelPart& part) {
    if (const auto known = materials_.find(index); known != materials_.end()) {
      part.material = known->second.first;
      return known->second.second;
    }
    Material material;
    material.name = "default";
    material.albedo = glm::vec3(1);
    Lookup albedo, normal;
    double normal_scale = 1;
    if (index >= 0) {
      const json& object = document_.element("materials", std::size_t(index));
      material.name = object.value("name", "material " + std::to_string(index));
      static const json none = json::object();
      const json& extensions = part_of(object, "extensions", none);
      const json& pbr = part_of(object, "pbrMetallicRoughness", none);
      const auto glossy = extensions.find("KHR_materials_pbrSpecularGlossiness");
      const bool diffuse = glossy != extensions.end();
      const json& base = diffuse ? *glossy : pbr;
      const auto factor = base.value(diffuse ? "diffuseFactor" : "baseColorFactor", std::array<double, 4>{1, 1, 1, 1});
      material.albedo = glm::vec3(factor[0], factor[1], factor[2]);
      albedo = read_lookup(base, diffuse ? "diffuseTexture" : "baseColorTexture");
      normal = read_lookup(object, "normalTexture");
      if (normal.texture >= 0) normal_scale = gltf_number(object["normalTexture"], "scale", 1);
      if (!diffuse && pbr.value("metallicFactor", 1.0) > 0)
        notes_.insert("metals are drawn as matt surfaces of their base colour");
      if (object.value("alphaMode", "OPAQUE") != "OPAQUE")
        notes_.insert("transparent and cut-out materials are drawn opaque");
      if (object.contains("emissiveTexture") ||
          object.value("emissiveFactor", std::array<double, 3>{}) != std::array<double, 3>{})
        notes_.insert("light that materials give is ignored");
      if (object.contains("occlusionTexture")) notes_.insert("occlusion maps are ignored: what surfaces see is traced");
      if (object.value("doubleSided", false))
        notes_.insert("both sides of double-sided materials are lit as their front");
    }
    Lookup lookup = normal.texture >= 0 ? normal : albedo;
    if (albedo.texture >= 0 && !albedo.same_place(lookup)) {
      notes_.insert("material '" + material.name +
                    "': albedo and normal map are placed differently; the albedo image is ignored");
      albedo.texture = -1;
    }
    if (albedo.texture >= 0) material.albedo_image = use_image(albedo.texture, false, 1);
    if (normal.texture >= 0) material.normal_image = use_image(normal.texture, true, normal_scale);
    part.material = int(model_.materials.size());
    model_.materials.push_back(material);
    materials_[index] = {part.material, lookup};
    return lookup;
  }

  int use_image(int texture, bool is_normal, double scale) {
    const auto key =
        std::make_tuple(gltf_index(document_.element("textures", std::size_t(texture)), "source"), is_normal, scale);
    if (const auto known = images_.find(key); known != images_.end()) return known->second;
    const GltfDocument::ImageSource source = document_.image_of_texture(std::size_t(texture));
    if (!source.file.empty()) model_.files.push_back(source.file);
    model_.images.push_back(read_for_model(document_.path(), [&] {
      const DecodedImage decoded =
          source.file.empty() ? decode_image_memory(source.bytes, source.name) : decode_image_file(source.file);
      if (!decoded.note.empty()) model_.notes.push_back(source.name + ": " + decoded.note);
      return is_normal ? normal_image(decoded, scale) : albedo_image(decoded, source.name);
    }));
    return images_[key] = int(model_.images.size()) - 1;
  }

  // The first camera of the scene that sees something.
  void read_camera(std::size_t node) {
    const auto index = gltf_integer(document_.element("nodes", node)["camera"]);
    const json& camera = document_.element("cameras", index);
    if (!camera.contains("perspective") && !camera.contains("orthographic")) return;
    if (model_.camera) {
      if (needs_camera_) notes_.insert("the first of its cameras is used; give another with --camera");
      return;
    }
    const std::string fault = gltf_camera_fault(camera, world_[node]);
    if (fault.empty())
      model_.camera = gltf_camera(camera, world_[node]);
    else if (needs_camera_)
      document_.fail("the camera of node " + std::to_string(node) + " " + fault +
                     "; repair it, or give another with --camera");
  }

  GltfDocument document_;
  bool needs_camera_;
  Model model_;
  std::vector<dmat4> world_;        // of each node
  std::vector<std::size_t> order_;  // nodes of the scene
  std::map<int, std::pair<int, Lookup>> materials_;
  std::map<std::tuple<int, bool, double>, int> images_;
  std::set<std::string> notes_;
};

}  // namespace

Model read_gltf_model(const std::string& path, bool needs_camera) { return Reader(path, needs_camera).read(); }

}  // namespace twinshade
