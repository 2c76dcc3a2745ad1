#include "bundle/bundle.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace twinshade {
namespace {

template <class T>
const T* find(const std::vector<T>& list, std::string_view name) {
  for (const T& item : list)
    if (item.name == name) return &item;
  return nullptr;
}

constexpr std::uint32_t kLargestFrame = 16384;

// GLSL has no such names, and messages would break off at a zero byte in one.
template <class T>
bool has_control_character(const std::vector<T>& list) {
  return std::any_of(list.begin(), list.end(), [](const T& item) {
    return std::any_of(item.name.begin(), item.name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  });
}

}  // namespace

const Attribute* Bundle::find_attribute(std::string_view name) const { return find(attributes, name); }
const Texture* Bundle::find_texture(std::string_view name) const { return find(textures, name); }
const Uniform* Bundle::find_uniform(std::string_view name) const { return find(uniforms, name); }
const Buffer* Bundle::find_buffer(std::string_view name) const { return find(buffers, name); }

const std::string* Bundle::find_note(std::string_view key) const {
  for (const auto& [note_key, value] : notes)
    if (note_key == key) return &value;
  return nullptr;
}

std::array<std::uint32_t, 2> viewport_size(std::uint32_t width, std::uint32_t height) {
  return {std::bit_ceil(width), std::bit_ceil(height)};
}

void fit_to_viewport(std::vector<float>& clip_positions, std::uint32_t width, std::uint32_t height) {
  const auto [viewport_width, viewport_height] = viewport_size(width, height);
  const double sx = double(width) / viewport_width, sy = double(height) / viewport_height;
  for (std::size_t i = 0; i + 3 < clip_positions.size(); i += 4) {
    const double w = clip_positions[i + 3];
    clip_positions[i] = float(clip_positions[i] * sx + w * (sx - 1.0));
    clip_positions[i + 1] = float(clip_positions[i + 1] * sy + w * (sy - 1.0));
  }
}

void validate(const Bundle& bundle, const std::string& origin) {
  const auto fail = [&](const std::string& what) { throw UserError(origin + ": " + what); };
  if (bundle.width == 0 || bundle.height == 0 || bundle.width > kLargestFrame || bundle.height > kLargestFrame)
    fail("frame size " + std::to_string(bundle.width) + "x" + std::to_string(bundle.height) +
         " is not within 1x1 to 16384x16384");
  if (has_control_character(bundle.attributes) || has_control_character(bundle.textures) ||
      has_control_character(bundle.uniforms) || has_control_character(bundle.buffers))
    fail("damaged bundle: a name has a control character in it; bake it again");
  if (bundle.clip_positions.size() % 4 != 0) fail("clip positions are not four floats a vertex");
  if (bundle.indices.size() % 3 != 0) fail("indices are not three a triangle");
  const std::size_t vertices = bundle.vertex_count();
  for (const std::uint32_t index : bundle.indices)
    if (index >= vertices)
      fail("vertex index " + std::to_string(index) + " is out of range: there are " + std::to_string(vertices) +
           " vertices");
  for (const Attribute& attribute : bundle.attributes) {
    if (attribute.components < 1 || attribute.components > 4 || attribute.scalar >= Scalar::boolean)
      fail("attribute " + attribute.name + " has an unsupported type");
    if (attribute.values.size() != vertices * attribute.components)
      fail("attribute " + attribute.name + " has " + std::to_string(attribute.values.size()) + " values, not " +
           std::to_string(vertices * attribute.components));
  }
  for (const Texture& texture : bundle.textures) {
    if (texture.kind > TextureKind::cube || texture.filter > Filter::linear || texture.wrap > Wrap::repeat)
      fail("texture " + texture.name + " has a kind, filter or wrapping that there is not");
    const std::uint32_t layers = texture.kind == TextureKind::two_d ? 1 : texture.kind == TextureKind::cube ? 6 : 0;
    if (texture.width == 0 || texture.height == 0 || texture.layers == 0 || (layers != 0 && texture.layers != layers) ||
        (texture.kind == TextureKind::cube && texture.width != texture.height))
      fail("texture " + texture.name + " has an impossible size");
    const std::size_t rows = texture.texels.size() / 4 / texture.width;  // whole: no product that could overflow
    if (texture.texels.size() % (std::size_t{texture.width} * 4) != 0 || rows % texture.height != 0 ||
        rows / texture.height != texture.layers)
      fail("texture " + texture.name + " does not hold width * height * layers RGBA texels");
  }
  for (const Uniform& uniform : bundle.uniforms) {
    if (uniform.columns < 1 || uniform.columns > 4 || uniform.rows < 1 || uniform.rows > 4 ||
        uniform.scalar > Scalar::boolean)
      fail("uniform " + uniform.name + " has an impossible type");
    const std::size_t elements = uniform.array_length == 0 ? 1 : uniform.array_length;
    if (uniform.values.size() != elements * uniform.columns * uniform.rows)
      fail("uniform " + uniform.name + " does not hold as many values as its type");
  }
}

}  // namespace twinshade
