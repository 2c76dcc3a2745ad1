// Small glTF files for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

class GltfWriter {
 public:
  nlohmann::json root = {
      {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
  std::string binary;

  // Index of a new bufferView over the given bytes.
  int view(const void* bytes, std::size_t size) {
    while (binary.size() % 4) binary += '\0';
    nlohmann::json entry = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}};
    binary.append(static_cast<const char*>(bytes), size);
    root["bufferViews"].push_back(entry);
    return int(root["bufferViews"].size()) - 1;
  }
  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int component_type, std::size_t count,
               bool normalized = false) {
    const int at = view(values.data(), values.size() * sizeof(T));
    root["accessors"].push_back({{"bufferView", at},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type},
                                 {"normalized", normalized}});
    return int(root["accessors"].size()) - 1;
  }
  int floats(const std::vector<float>& values, const char* type, std::size_t components) {
    return accessor(values, type, 5126, values.size() / components);
  }
  int indices(const std::vector<std::uint16_t>& values) { return accessor(values, "SCALAR", 5123, values.size()); }

  // A square in the plane z = 0, [0, 1]^2, counter-clockwise from +z; with uvs (v downwards) and normals where wanted.
  nlohmann::json square(bool normals = true, bool uvs = true) {
    nlohmann::json primitive;
    primitive["attributes"]["POSITION"] = floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    if (normals) primitive["attributes"]["NORMAL"] = floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    if (uvs) primitive["attributes"]["TEXCOORD_0"] = floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
    primitive["indices"] = indices({0, 1, 2, 0, 2, 3});
    return primitive;
  }
  void mesh(const nlohmann::json& primitive) { root["meshes"].push_back({{"primitives", {primitive}}}); }

  // Text of the .gltf whose buffer is in the file `uri`.
  std::string gltf(const std::string& uri) {
    root["buffers"] = nlohmann::json::array({{{"uri", uri}, {"byteLength", binary.size()}}});
    return root.dump();
  }
  std::string glb() {
    root["buffers"] = nlohmann::json::array({{{"byteLength", binary.size()}}});
    std::string json = root.dump(), data = binary;
    while (json.size() % 4) json += ' ';
    while (data.size() % 4) data += '\0';
    const auto word = [](std::size_t n) {
      const auto w = std::uint32_t(n);
      std::string bytes(4, '\0');
      std::memcpy(bytes.data(), &w, 4);
      return bytes;
    };
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + data.size()) + word(json.size()) + "JSON" + json +
           word(data.size()) + std::string("BIN\0", 4) + data;
  }
};
