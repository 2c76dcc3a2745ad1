// A glTF 2.0 file's JSON and binary data, every access checked against what is there.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#if !JSON_DIAGNOSTICS
#error "JSON_DIAGNOSTICS=1 is needed wherever this is included: with it JSON has another layout"
#endif
#include <string>
#include <string_view>
#include <vector>

namespace twinshade {

class GltfDocument {
 public:
  // .gltf or .glb, by content. UserError: not glTF 2.x, truncated, missing or short buffers, required extensions that
  // are not supported (by name).
  explicit GltfDocument(const std::string& path);

  [[noreturn]] void fail(const std::string& what) const;  // UserError: "path: what"
  // The same for what is not there or of another type, with its place in the JSON where it has one.
  [[noreturn]] void fail_damaged(const nlohmann::json::exception& error) const;

  const std::string& path() const { return path_; }
  // This file and its buffers.
  const std::vector<std::string>& files() const { return files_; }
  // Element `index` of the top-level array `kind`, as in element("nodes", 3).
  const nlohmann::json& element(const char* kind, std::size_t index) const;
  std::size_t count(const char* kind) const;
  std::size_t default_scene() const;

  // An accessor's elements, components fastest, integers converted as `normalized` says; sparse ones resolved.
  struct Numbers {
    std::uint32_t components = 0;
    std::vector<float> values;
    std::size_t count() const { return components ? values.size() / components : 0; }
  };
  Numbers numbers(std::size_t accessor) const;
  // Unsigned integers, as indices and joints are.
  std::vector<std::uint32_t> integers(std::size_t accessor) const;

  // A texture's image: bytes and a name for messages, for an image in a buffer or a data URI; else `file` is the path.
  struct ImageSource {
    std::string name, bytes, file;
  };
  ImageSource image_of_texture(std::size_t texture) const;

 private:
  struct Layout;
  void read_container(const std::string& content);
  void check_version() const;
  void check_extensions() const;
  void read_buffers();
  std::string resource(const std::string& uri, const std::string& what, std::string* file) const;
  std::string_view view(std::size_t buffer_view) const;
  Layout layout(std::size_t accessor) const;
  template <class Read>
  void for_each_component(const Layout& layout, Read read) const;

  std::string path_;
  nlohmann::json root_;
  std::string_view binary_chunk_;  // of a .glb, while reading
  std::vector<std::string> buffers_, files_;
};

// A number, or `fallback` where the key is missing.
double gltf_number(const nlohmann::json& object, const char* key, double fallback);
// A number that counts or names something. These throw what nlohmann throws for other types, with the place.
std::uint64_t gltf_integer(const nlohmann::json& value);
// An index into another array; -1 where the key is missing.
int gltf_index(const nlohmann::json& object, const char* key);

}  // namespace twinshade
