// The bundle: everything a renderer needs to draw one frame, as one hashed file or memory image. Bakers write it,
// renderers read it, and both machines draw from the same one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace twinshade {

enum class Scalar : std::uint8_t { f32 = 0, i32 = 1, u32 = 2, boolean = 3 };

// Per-vertex data that a fragment shader reads through an `in` of the same name.
struct Attribute {
  std::string name;
  Scalar scalar = Scalar::f32;   // i32 and u32 are interpolated flat (provoking vertex: the last)
  std::uint32_t components = 1;  // 1 to 4
  // vertex_count * components values, component fastest; integers by their bit pattern.
  std::vector<float> values;
};

enum class TextureKind : std::uint8_t { two_d = 0, two_d_array = 1, cube = 2 };
enum class Filter : std::uint8_t { nearest = 0, linear = 1 };
enum class Wrap : std::uint8_t { clamp_to_edge = 0, repeat = 1 };

// RGBA32F texels, one mip level. Row 0 is at t = 0 (OpenGL's bottom row). Cube: layers in GL face order +X -X +Y -Y +Z -Z.
struct Texture {
  std::string name;
  TextureKind kind = TextureKind::two_d;
  std::uint32_t width = 0, height = 0, layers = 1;  // layers: 1 for 2D, 6 for cube
  Filter filter = Filter::linear;                   // used by texture()/textureLod() only
  Wrap wrap = Wrap::clamp_to_edge;
  std::vector<float> texels;  // width * height * layers * 4; x fastest, then y, then layer
};

// A uniform outside any block. Matrices column-major. Arrays and struct members are set by GLSL path: "light.colour", "k[0]"
// names the whole array k.
struct Uniform {
  std::string name;
  Scalar scalar = Scalar::f32;
  std::uint32_t columns = 1, rows = 1;  // vecN: columns 1, rows N
  std::uint32_t array_length = 0;       // 0: not an array
  std::vector<float> values;            // integers by bit pattern, booleans as integer 0 or 1; tightly packed
};

// Contents of a uniform block (std140) or storage buffer (its declared layout), bound by block name.
struct Buffer {
  std::string name;
  bool storage = false;
  std::vector<std::byte> bytes;
};

struct Bundle {
  std::uint32_t width = 0, height = 0;  // of the frame, 1 to 16384

  // Clip-space positions as gl_Position gets them: OpenGL conventions (z from -w to w), already fitted to the
  // power-of-two viewport (see viewport_size). 4 floats a vertex.
  std::vector<float> clip_positions;
  std::vector<std::uint32_t> indices;  // 3 a triangle; primitive id = position / 3
  bool cull_back_faces = false;

  std::vector<Attribute> attributes;
  std::vector<Texture> textures;
  std::vector<Uniform> uniforms;
  std::vector<Buffer> buffers;

  // Where it came from: scene, environment, technique names, seed ... (key, value), in a fixed order. Part of the hash.
  std::vector<std::pair<std::string, std::string>> notes;

  std::size_t vertex_count() const { return clip_positions.size() / 4; }
  std::size_t triangle_count() const { return indices.size() / 3; }
  const Attribute* find_attribute(std::string_view name) const;
  const Texture* find_texture(std::string_view name) const;
  const Uniform* find_uniform(std::string_view name) const;
  const Buffer* find_buffer(std::string_view name) const;
  const std::string* find_note(std::string_view key) const;
};

// The viewport that makes coverage independent of fused multiply-add: the next power of two of each dimension. The frame is
// its lower-left part. Clip positions are fitted to it by fit_to_viewport.
std::array<std::uint32_t, 2> viewport_size(std::uint32_t width, std::uint32_t height);

// Rewrites clip positions made for a viewport of exactly width x height (x, y in [-w, w] visible) so that the same picture
// lands in the lower-left width x height pixels of the power-of-two viewport.
// x' = x * (width / W) + w * (width / W - 1), in double, rounded once.
void fit_to_viewport(std::vector<float>& clip_positions, std::uint32_t width, std::uint32_t height);

// Checks sizes against each other (index range, attribute and texture lengths, frame size). UserError naming `origin` and
// the part that is wrong.
void validate(const Bundle& bundle, const std::string& origin);

// Little-endian, versioned, SHA-256 of the content at the end. Deterministic: equal bundles give equal bytes.
std::string serialize(const Bundle& bundle);
// UserError naming `origin` where the bytes are truncated, damaged (hash) or of another version.
Bundle deserialize(std::string_view bytes, const std::string& origin);

void write_bundle(const std::string& path, const Bundle& bundle);
Bundle read_bundle(const std::string& path);
bool looks_like_bundle(std::string_view first_bytes);

// SHA-256 of serialize(bundle), hex.
std::string bundle_hash(const Bundle& bundle);

}  // namespace twinshade
