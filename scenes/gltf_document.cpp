// Khronos Group, glTF 2.0 specification (ISO/IEC 12113:2022), sections 3.6 (binary data), 3.12 (extensions), 4 (GLB).
// Read here and not by a model library, since normalised integers, sparse accessors, quantised attributes and files
// that were cut or damaged must all be read exactly or refused by name.
#include "scenes/gltf_document.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "scenes/read_for_model.h"

namespace twinshade {
namespace {

using nlohmann::json;

// Extensions that change neither geometry nor what this program draws of a material, and those that are implemented
// (the first four; of KHR_materials_pbrSpecularGlossiness the diffuse part).
constexpr std::array kSupported = {"KHR_texture_transform",
                                   "EXT_mesh_gpu_instancing",
                                   "KHR_mesh_quantization",
                                   "KHR_materials_pbrSpecularGlossiness",
                                   "KHR_materials_unlit",
                                   "KHR_materials_anisotropy",
                                   "KHR_materials_clearcoat",
                                   "KHR_materials_dispersion",
                                   "KHR_materials_emissive_strength",
                                   "KHR_materials_ior",
                                   "KHR_materials_iridescence",
                                   "KHR_materials_sheen",
                                   "KHR_materials_specular",
                                   "KHR_materials_variants",
                                   "KHR_lights_punctual",
                                   "KHR_xmp_json_ld"};

// No accessor of a sound file has more elements; a damaged count must not ask for all memory.
constexpr std::uint64_t kMostElements = 1u << 28;
// All zeros but for a sparse part, of which a small file may claim any number.
constexpr std::uint64_t kMostElementsWithoutView = 1u << 20;

// Linux' PATH_MAX.
constexpr std::size_t kLongestPath = 4096;
constexpr int kDeepest =
    200;  // brackets within brackets, as in shaders: values are copied by functions that call themselves

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return text;
}

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::uint64_t unsigned_number(const json& object, const char* key, std::uint64_t fallback) {
  const auto found = object.find(key);
  return found == object.end() ? fallback : gltf_integer(*found);
}

std::string percent_decoded(const std::string& uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto hex = [](char c) {
      return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
    };
    if (uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0) {
      result += char(hex(uri[i + 1]) * 16 + hex(uri[i + 2]));
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

// RFC 4648; false where a character does not belong.
bool base64_decoded(std::string_view text, std::string& bytes) {
  std::uint32_t bits = 0;
  int count = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) return false;
    bits = bits << 6 | std::uint32_t(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += char(bits >> count & 0xff);
    }
  }
  return true;
}

// "[json.exception.type_error.302] type must be number, but is string"
std::string without_library_name(const json::exception& error) {
  const std::string what = error.what();
  const std::size_t end = what.find("] ");
  return what[0] == '[' && end != std::string::npos ? what.substr(end + 2) : what;
}

}  // namespace

double gltf_number(const json& object, const char* key, double fallback) {
  const auto found = object.find(key);
  return found == object.end() ? fallback : found->get<double>();
}

std::uint64_t gltf_integer(const json& value) {
  if (value.is_number() && !value.is_number_unsigned())
    throw json::type_error::create(302, "must be an integer from 0 on, but is " + value.dump(), &value);
  return value.get<std::uint64_t>();
}

int gltf_index(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return -1;
  const std::uint64_t index = gltf_integer(*found);
  if (index > kMostElements) throw json::type_error::create(302, "there is no " + std::to_string(index), &*found);
  return int(index);
}

// Where an accessor's elements lie.
struct GltfDocument::Layout {
  std::uint64_t count = 0;
  std::uint32_t components = 0, component_type = 0, component_size = 0;
  bool normalized = false;
  std::string_view bytes;  // from the first element on; empty: all zeros
  std::size_t stride = 0;
  std::size_t column_stride = 0, rows = 0;  // matrices: columns start at multiples of 4 bytes
  std::vector<std::uint32_t> sparse_indices;
  std::string_view sparse_bytes;
};

GltfDocument::GltfDocument(const std::string& path) : path_(path) {
  files_.push_back(path);
  const std::string content = read_file(path);
  if (content.empty()) fail("the file is empty");
  read_container(content);
  if (!root_.is_object()) fail("not a glTF file: no JSON object");
  try {
    check_version();
    check_extensions();
    read_buffers();
  } catch (const json::exception& error) {
    fail_damaged(error);
  }
}

void GltfDocument::check_version() const {
  const std::string version = root_.contains("asset") ? root_.at("asset").value("version", "") : "";
  if (version.substr(0, 2) != "2.") fail("glTF version '" + version + "' is not supported; only 2.x is");
  if (const std::string least = root_.at("asset").value("minVersion", "2.0"); least != "2.0")
    fail("needs glTF " + least + " (asset.minVersion), which is not supported; export the model as 2.0");
}

// The JSON library quotes what it read last, which may be megabytes of a data URI; names in a file may be as long.
void GltfDocument::fail(const std::string& what) const {
  constexpr std::size_t kMost = 300;
  std::string line = what.substr(0, what.find("; last read: "));
  if (line.size() > kMost) line = line.substr(0, kMost) + " ...";
  line = path_ + ": " + line;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  throw UserError(line);
}

void GltfDocument::fail_damaged(const json::exception& error) const {
  std::string what = without_library_name(error);
  if (what[0] == '(')  // "(/buffers/0) key 'byteLength' not found"
    if (const std::size_t end = what.find(") "); end != std::string::npos)
      what = what.substr(1, end - 1) + ": " + what.substr(end + 2);
  fail("damaged: " + what);
}

void GltfDocument::read_container(const std::string& content) {
  std::string_view text = content;
  if (text.substr(0, 4) == "glTF") {
    if (text.size() < 20) fail("truncated: a .glb file is longer than " + std::to_string(text.size()) + " bytes");
    const std::uint32_t version = little_endian(text, 4), length = little_endian(text, 8);
    if (version != 2) fail("GLB version " + std::to_string(version) + " is not supported; only 2 is");
    if (length > text.size()) fail("truncated: " + std::to_string(text.size()) + " bytes of " + std::to_string(length));
    std::string_view chunk;
    for (std::size_t at = 12; at + 8 <= length;) {
      const std::uint32_t size = little_endian(text, at), type = little_endian(text, at + 4);
      if (size > length - at - 8) fail("truncated or damaged: a chunk ends beyond the file");
      if (type == 0x4e4f534a && chunk.empty()) chunk = text.substr(at + 8, size);                  // "JSON"
      if (type == 0x004e4942 && binary_chunk_.empty()) binary_chunk_ = text.substr(at + 8, size);  // "BIN"
      at += 8 + std::size_t(size);
    }
    text = chunk;
  }
  const auto shallow = [&](int depth, json::parse_event_t, json&) {
    if (depth > kDeepest)
      fail("damaged: brackets stand " + std::to_string(kDeepest) + " deep in each other, and deeper");
    return true;
  };
  try {
    root_ = json::parse(text, shallow);
  } catch (const json::exception& error) {
    fail("truncated or damaged JSON: " + without_library_name(error));
  }
}

void GltfDocument::check_extensions() const {
  const auto required = root_.find("extensionsRequired");
  if (required == root_.end()) return;
  for (const json& entry : *required) {
    const auto name = entry.get<std::string>();
    if (std::find(kSupported.begin(), kSupported.end(), name) == kSupported.end())
      fail("requires the glTF extension " + name + ", which is not supported; export the model without it");
  }
}

const json& GltfDocument::element(const char* kind, std::size_t index) const {
  if (index >= count(kind)) fail("damaged: " + std::string(kind) + " has no element " + std::to_string(index));
  return root_.at(kind)[index];
}

std::size_t GltfDocument::count(const char* kind) const {
  const auto found = root_.find(kind);
  if (found == root_.end()) return 0;
  if (!found->is_array()) fail("damaged: " + std::string(kind) + " is not an array");
  return found->size();
}

std::size_t GltfDocument::default_scene() const { return std::size_t(std::max(0, gltf_index(root_, "scene"))); }

// The bytes of a data URI, else the path of the file that the URI names beside this one.
std::string GltfDocument::resource(const std::string& uri, const std::string& what, std::string* file) const {
  if (uri.empty()) fail("damaged: the URI of " + what + " is empty");
  if (lower_case(uri.substr(0, 5)) == "data:") {
    const std::size_t comma = uri.find(',');
    std::string bytes;
    if (comma == std::string::npos || lower_case(uri.substr(0, comma)).find(";base64") == std::string::npos ||
        !base64_decoded(std::string_view(uri).substr(comma + 1), bytes))
      fail("damaged: the data URI of " + what + " is not base64");
    return bytes;
  }
  if (uri.find("://") != std::string::npos)
    fail(what + " is not beside the model (" + uri + "); only files there are read: write its path from the model's");
  const std::string name = percent_decoded(uri);
  if (name.size() > kLongestPath)
    fail("damaged: the URI of " + what + " has " + std::to_string(name.size()) + " bytes");
  for (char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      fail("damaged: the URI of " + what + " has a control character in it (" + uri + ")");
  *file = (std::filesystem::path(path_).parent_path() / name).string();
  return "";
}

// binary_chunk_ still points into the file's content.
void GltfDocument::read_buffers() {
  for (std::size_t i = 0; i < count("buffers"); ++i) {
    const json& buffer = element("buffers", i);
    const std::string what = "buffer " + std::to_string(i);
    const std::uint64_t length = gltf_integer(buffer.at("byteLength"));
    std::string bytes, file;
    if (buffer.contains("uri")) {
      bytes = resource(buffer["uri"].get<std::string>(), what, &file);
      if (!file.empty()) {
        files_.push_back(file);
        bytes = read_for_model(path_, [&] { return read_file(file); });
      }
    } else if (i == 0) {
      bytes = binary_chunk_;
    }
    if (bytes.size() < length)
      fail("truncated: " + (file.empty() ? what : file) + " has " + std::to_string(bytes.size()) + " bytes, " +
           std::to_string(length) + " are needed");
    bytes.resize(std::size_t(length));
    buffers_.push_back(std::move(bytes));
  }
  binary_chunk_ = {};
}

std::string_view GltfDocument::view(std::size_t buffer_view) const {
  const json& object = element("bufferViews", buffer_view);
  const int buffer = gltf_index(object, "buffer");
  if (buffer < 0 || std::size_t(buffer) >= buffers_.size())
    fail("damaged: bufferView " + std::to_string(buffer_view) + " has no buffer");
  const std::uint64_t offset = unsigned_number(object, "byteOffset", 0), length = gltf_integer(object.at("byteLength"));
  const std::string& bytes = buffers_[std::size_t(buffer)];
  if (offset > bytes.size() || length > bytes.size() - offset)
    fail("damaged: bufferView " + std::to_string(buffer_view) + " ends beyond its buffer");
  return std::string_view(bytes).substr(std::size_t(offset), std::size_t(length));
}

GltfDocument::Layout GltfDocument::layout(std::size_t accessor) const {
  const json& object = element("accessors", accessor);
  const std::string name = "accessor " + std::to_string(accessor);
  Layout result;
  result.count = gltf_integer(object.at("count"));
  if (result.count > kMostElements) fail("damaged: " + name + " has " + std::to_string(result.count) + " elements");
  result.normalized = object.value("normalized", false);
  const auto type = object.at("type").get<std::string>();
  std::uint32_t columns = 1;
  result.rows = type == "SCALAR" ? 1 : 0;
  for (std::uint32_t n = 2; n <= 4; ++n) {
    if (type == "VEC" + std::to_string(n)) result.rows = n;
    if (type == "MAT" + std::to_string(n)) result.rows = columns = n;
  }
  if (result.rows == 0) fail("damaged: " + name + " has the type " + type);
  result.components = std::uint32_t(result.rows) * columns;
  result.component_type = std::uint32_t(gltf_integer(object.at("componentType")));
  switch (result.component_type) {
    case 5120:
    case 5121:
      result.component_size = 1;
      break;
    case 5122:
    case 5123:
      result.component_size = 2;
      break;
    case 5125:
    case 5126:
      result.component_size = 4;
      break;
    default:
      fail("damaged: " + name + " has the component type " + std::to_string(result.component_type));
  }
  result.column_stride =
      columns == 1 ? result.rows * result.component_size : (result.rows * result.component_size + 3) / 4 * 4;
  const std::size_t size = columns * result.column_stride;
  const auto fit = [&](std::string_view bytes, std::uint64_t offset, std::size_t element, std::size_t stride,
                       std::uint64_t count, const char* part) {
    if (count > 0 && (offset > bytes.size() || element > bytes.size() - offset ||
                      (count - 1) > (bytes.size() - offset - element) / stride))
      fail("damaged: " + name + part + " ends beyond its bufferView");
    return bytes.substr(std::size_t(std::min<std::uint64_t>(offset, bytes.size())));
  };
  if (const int index = gltf_index(object, "bufferView"); index >= 0) {
    result.stride = std::size_t(unsigned_number(element("bufferViews", std::size_t(index)), "byteStride", size));
    if (result.stride < size)
      fail("damaged: " + name + " has elements of " + std::to_string(size) + " bytes, but bufferView " +
           std::to_string(index) + " a byteStride of " + std::to_string(result.stride));
    result.bytes =
        fit(view(std::size_t(index)), unsigned_number(object, "byteOffset", 0), size, result.stride, result.count, "");
  } else if (result.count > kMostElementsWithoutView) {
    fail("not supported: " + name + " has " + std::to_string(result.count) +
         " elements without a bufferView, of which " + std::to_string(kMostElementsWithoutView) + " may be");
  }
  if (const auto sparse = object.find("sparse"); sparse != object.end()) {
    const std::uint64_t count = gltf_integer(sparse->at("count"));
    const json &indices = sparse->at("indices"), &values = sparse->at("values");
    const std::uint64_t index_type = gltf_integer(indices.at("componentType"));
    if (index_type != 5121 && index_type != 5123 && index_type != 5125)
      fail("damaged: " + name + "'s sparse part has indices of the component type " + std::to_string(index_type));
    const std::size_t index_size = index_type == 5121 ? 1 : index_type == 5123 ? 2 : 4;
    const std::string_view index_bytes =
        fit(view(gltf_integer(indices.at("bufferView"))), unsigned_number(indices, "byteOffset", 0), index_size,
            index_size, count, "'s sparse part");
    result.sparse_bytes = fit(view(gltf_integer(values.at("bufferView"))), unsigned_number(values, "byteOffset", 0),
                              size, size, count, "'s sparse part");
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t index = 0;
      std::memcpy(&index, index_bytes.data() + i * index_size, index_size);
      if (index >= result.count) fail("damaged: " + name + "'s sparse part replaces element " + std::to_string(index));
      result.sparse_indices.push_back(index);
    }
  }
  return result;
}

// read(element, component, bytes of the component), the sparse ones last.
template <class Read>
void GltfDocument::for_each_component(const Layout& layout, Read read) const {
  const auto element = [&](std::size_t to, const char* bytes) {
    for (std::uint32_t c = 0; c < layout.components; ++c)
      read(to, c, bytes + c / layout.rows * layout.column_stride + c % layout.rows * layout.component_size);
  };
  if (!layout.bytes.empty())
    for (std::size_t i = 0; i < layout.count; ++i) element(i, layout.bytes.data() + i * layout.stride);
  const std::size_t size = layout.components / layout.rows * layout.column_stride;
  for (std::size_t i = 0; i < layout.sparse_indices.size(); ++i)
    element(layout.sparse_indices[i], layout.sparse_bytes.data() + i * size);
}

GltfDocument::Numbers GltfDocument::numbers(std::size_t accessor) const {
  const Layout from = layout(accessor);
  Numbers result{from.components, std::vector<float>(std::size_t(from.count) * from.components)};
  const auto value = [&]<class T>(T, const char* bytes, double largest) {
    T raw;
    std::memcpy(&raw, bytes, sizeof raw);
    return from.normalized ? float(std::max(double(raw) / largest, -1.0)) : float(raw);
  };
  for_each_component(from, [&](std::size_t i, std::uint32_t c, const char* bytes) {
    float& out = result.values[i * from.components + c];
    switch (from.component_type) {
      case 5120:
        out = value(std::int8_t{}, bytes, 127);
        break;
      case 5121:
        out = value(std::uint8_t{}, bytes, 255);
        break;
      case 5122:
        out = value(std::int16_t{}, bytes, 32767);
        break;
      case 5123:
        out = value(std::uint16_t{}, bytes, 65535);
        break;
      case 5125:
        out = value(std::uint32_t{}, bytes, 4294967295.0);
        break;
      default:
        std::memcpy(&out, bytes, sizeof out);
    }
  });
  return result;
}

std::vector<std::uint32_t> GltfDocument::integers(std::size_t accessor) const {
  const Layout from = layout(accessor);
  if (from.component_type == 5126 || from.component_type == 5120 || from.component_type == 5122)
    fail("damaged: accessor " + std::to_string(accessor) + " does not hold unsigned integers");
  std::vector<std::uint32_t> result(std::size_t(from.count) * from.components);
  for_each_component(from, [&](std::size_t i, std::uint32_t c, const char* bytes) {
    std::memcpy(&result[i * from.components + c], bytes, from.component_size);
  });
  return result;
}

GltfDocument::ImageSource GltfDocument::image_of_texture(std::size_t texture) const {
  const int source = gltf_index(element("textures", texture), "source");
  if (source < 0) fail("texture " + std::to_string(texture) + " has no PNG or JPEG image");
  const json& image = element("images", std::size_t(source));
  ImageSource result;
  result.name = path_ + ": image " + std::to_string(source);
  if (image.contains("uri"))
    result.bytes = resource(image["uri"].get<std::string>(), "image " + std::to_string(source), &result.file);
  else
    result.bytes = view(gltf_integer(image.at("bufferView")));
  if (!result.file.empty()) result.name = result.file;
  return result;
}

}  // namespace twinshade
