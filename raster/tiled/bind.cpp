#include "raster/tiled/bind.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/parallel.h"
#include "bundle/uniform_text.h"
#include "raster/tiled/tiled_renderer.h"

namespace twinshade::tiled {
namespace {

std::string quoted(std::string_view name) { return '"' + std::string(name) + '"'; }

// "the bundle has a, b, c" or "the bundle has none".
template <class T>
std::string inventory(const std::vector<T>& items) {
  constexpr std::size_t kMost = 24;
  std::string list;
  for (std::size_t i = 0; i < std::min(items.size(), kMost); ++i) list.append(i ? ", " : "").append(items[i].name);
  if (items.size() > kMost) list += ", and " + std::to_string(items.size() - kMost) + " more";
  return "the bundle has " + (list.empty() ? "none" : list);
}

// Element e, column c of an input as the bundle names it: arrays and matrices are one attribute an element or column.
std::string attribute_name(const ShaderVariable& input, std::uint32_t element, std::uint32_t column) {
  std::string name = input.name;
  if (input.array_length > 0) name.append("[").append(std::to_string(element)).append("]");
  if (input.columns > 1) name.append("[").append(std::to_string(column)).append("]");
  return name;
}

// Floats from row to row of a texture that is laid out anew, for rows of `floats`. Texels above each other are read
// together, and rows a power of two apart share the sets of a cache: they evict each other from one that is nearly
// empty. Such rows are made 9 lines more than a multiple of 16; short ones are left, their texture is small.
std::size_t row_pitch(std::size_t floats) {
  constexpr std::size_t kLine = 16;
  if (floats % (8 * kLine) != 0 || floats < 16 * kLine) return floats;
  return (floats / kLine + 6) / 16 * 16 * kLine + 9 * kLine;
}

// More than the nearest caches hold beside what else a shader reads.
constexpr std::size_t kLargeTexture = std::size_t{1} << 19;  // bytes

class Binder {
 public:
  Binder(const Bundle& bundle, const ShaderModule& module, AttributeMode mode, std::uint32_t output)
      : bundle_(bundle), module_(module), mode_(mode), output_(output) {}

  BoundDraw bind() {
    bind_inputs();
    bind_uniforms();
    bind_resources();
    choose_color();
    find_texels_ahead();
    return std::move(draw_);
  }

 private:
  // variable: as the shader declares it.
  [[noreturn]] void fail(const char* variable, const std::string& what) const {
    throw UnboundError(module_.name, variable, what);
  }

  void bind_inputs() {
    draw_.input_components = module_.input_components;
    draw_.vertex_inputs.resize(bundle_.vertex_count() * module_.input_components);
    draw_.interpolation.resize(module_.input_components);
    draw_.input_scalars.resize(module_.input_components);
    draw_.component_names.resize(module_.input_components);
    for (std::uint32_t i = 0; i < module_.input_count; ++i) {
      const ShaderVariable& input = module_.inputs[i];
      const bool flat = input.flat || input.scalar != Scalar::f32;
      if (input.noperspective && !flat && mode_ == AttributeMode::exact)
        fail(input.name, "input " + quoted(input.name) +
                             " is noperspective, which only native attributes have: draw with --attributes native");
      std::uint32_t component = input.first_component;
      for (std::uint32_t element = 0; element < std::max(1u, input.array_length); ++element)
        for (std::uint32_t column = 0; column < input.columns; ++column, component += input.rows)
          bind_attribute(input, attribute_name(input, element, column), component,
                         flat                  ? Interpolation::flat
                         : input.noperspective ? Interpolation::linear
                                               : Interpolation::smooth);
    }
  }

  void bind_attribute(const ShaderVariable& input, const std::string& name, std::uint32_t component,
                      Interpolation interpolation) {
    const Attribute* attribute = bundle_.find_attribute(name);
    if (!attribute)
      fail(input.name, "input " + quoted(name) + " is not in the bundle; " + inventory(bundle_.attributes));
    if (attribute->scalar != input.scalar || attribute->components != input.rows)
      fail(input.name, "input " + quoted(name) + " is declared " + glsl_type(input.scalar, 1, input.rows, 0) +
                           ", but the bundle's attribute is " +
                           glsl_type(attribute->scalar, 1, attribute->components, 0));
    const std::size_t stride = module_.input_components;
    for (std::size_t v = 0; v < bundle_.vertex_count(); ++v)
      std::copy_n(&attribute->values[v * input.rows], input.rows, &draw_.vertex_inputs[v * stride + component]);
    for (std::uint32_t row = 0; row < input.rows; ++row) {
      draw_.interpolation[component + row] = interpolation;
      draw_.input_scalars[component + row] = input.scalar;
      draw_.component_names[component + row] = input.rows == 1 ? name : name + "." + "xyzw"[row];
    }
  }

  void bind_uniforms() {
    draw_.uniforms.assign(module_.uniform_bytes, std::byte{0});
    for (std::uint32_t i = 0; i < module_.uniform_count; ++i) {
      const ShaderUniform& wanted = module_.uniforms[i];
      const Uniform* uniform = bundle_.find_uniform(wanted.name);
      if (!uniform && wanted.array_length > 0) uniform = bundle_.find_uniform(std::string(wanted.name) + "[0]");
      if (!uniform && wanted.initial != nullptr) {
        put_uniform(wanted, wanted.initial);
        continue;
      }
      if (!uniform)
        fail(wanted.name,
             "uniform " + quoted(wanted.name) + " is not in the bundle and has no initial value: " +
                 initial_value_remedy(wanted.name, wanted.scalar, wanted.columns, wanted.rows, wanted.array_length) +
                 "; " + inventory(bundle_.uniforms));
      const std::string wanted_type = glsl_type(wanted.scalar, wanted.columns, wanted.rows, wanted.array_length);
      const std::string type = glsl_type(uniform->scalar, uniform->columns, uniform->rows, uniform->array_length);
      if (type != wanted_type)
        fail(wanted.name,
             "uniform " + quoted(wanted.name) + " is declared " + wanted_type + ", but the bundle's is " + type);
      put_uniform(wanted, uniform->values.data());
    }
  }

  // word: of 4 bytes, element-major, column-major.
  template <class Word>
  void put_uniform(const ShaderUniform& wanted, const Word* word) {
    for (std::uint32_t element = 0; element < std::max(1u, wanted.array_length); ++element)
      for (std::uint32_t column = 0; column < wanted.columns; ++column, word += wanted.rows)
        std::memcpy(&draw_.uniforms[wanted.offset + element * wanted.array_stride + column * wanted.matrix_stride],
                    word, wanted.rows * sizeof(Word));
  }

  void bind_resources() {
    draw_.textures.resize(module_.texture_count);
    draw_.buffers.resize(module_.buffer_count);
    draw_.buffer_bytes.resize(module_.buffer_count);
    draw_.buffer_names.resize(module_.buffer_count);
    for (std::uint32_t i = 0; i < module_.resource_count; ++i) {
      const ShaderResource& wanted = module_.resources[i];
      switch (wanted.kind) {
        case ResourceKind::uniform_block:
          bind_buffer(wanted, false);
          break;
        case ResourceKind::storage_buffer:
          bind_buffer(wanted, true);
          break;
        case ResourceKind::sampler_2d:
          bind_texture(wanted, TextureKind::two_d, "sampler2D");
          break;
        case ResourceKind::sampler_2d_array:
          bind_texture(wanted, TextureKind::two_d_array, "sampler2DArray");
          break;
        case ResourceKind::sampler_cube:
          bind_texture(wanted, TextureKind::cube, "samplerCube");
          break;
      }
    }
    for (std::uint32_t i = 0; i < module_.resource_count; ++i)
      if (module_.resources[i].beside >= 0)
        put_beside(draw_.textures[module_.resources[i].slot], draw_.textures[std::size_t(module_.resources[i].beside)]);
    for (TextureView& view : draw_.textures) move_rows_apart(view);
    for (std::uint32_t i = 0; i < module_.resource_count; ++i)
      if (module_.resources[i].kind >= ResourceKind::sampler_2d)
        check_places(module_.resources[i], draw_.textures[module_.resources[i].slot]);
  }

  void bind_buffer(const ShaderResource& wanted, bool storage) {
    const std::string what = (storage ? "storage buffer " : "uniform block ") + quoted(wanted.name);
    const Buffer* buffer = bundle_.find_buffer(wanted.name);
    if (!buffer) fail(wanted.name, what + " is not in the bundle; " + inventory(bundle_.buffers));
    if (buffer->storage != storage)
      fail(wanted.name,
           what + ": the bundle's buffer of that name is a " + (buffer->storage ? "storage buffer" : "uniform block"));
    if (buffer->bytes.size() < wanted.minimum_size)
      fail(wanted.name, what + " needs " + std::to_string(wanted.minimum_size) + " bytes, but the bundle's has " +
                            std::to_string(buffer->bytes.size()));
    std::vector<std::byte>& copy = draw_.buffer_bytes[wanted.slot];
    copy = buffer->bytes;
    draw_.buffer_names[wanted.slot] = wanted.name;
    draw_.buffers[wanted.slot] = {copy.data(), copy.size()};
  }

  void bind_texture(const ShaderResource& wanted, TextureKind kind, const char* sampler) {
    static constexpr const char* kKinds[] = {"2D texture", "2D array texture", "cube texture"};
    const Texture* texture = bundle_.find_texture(wanted.name);
    if (!texture)
      fail(wanted.name, "texture " + quoted(wanted.name) + " is not in the bundle; " + inventory(bundle_.textures));
    if (texture->kind != kind)
      fail(wanted.name, std::string(sampler) + " " + quoted(wanted.name) + " does not fit the bundle's " +
                            kKinds[int(texture->kind)]);
    TextureView& view = draw_.textures[wanted.slot];
    view.texels = texture->texels.data();
    view.width = std::int32_t(texture->width);
    view.height = std::int32_t(texture->height);
    view.layers = std::int32_t(texture->layers);
    view.row_pitch = std::ptrdiff_t(texture->width) * 4;
    view.layer_pitch = view.row_pitch * std::ptrdiff_t(texture->height);
    view.kind = kind;
    view.filter = texture->filter;
    view.wrap = texture->wrap;
    check_places(wanted, view);
    if (wanted.layer_order == LayerOrder::together) interleave(view, wanted.layers_read);
    if (wanted.layer_order == LayerOrder::colors_together) interleave_colors(view);
  }

  // Places of texels are 32-bit numbers of twos of floats.
  void check_places(const ShaderResource& resource, const TextureView& view) const {
    const std::uint64_t last = std::uint64_t(view.width - 1) * std::uint64_t(view.texel_pitch) +
                               std::uint64_t(view.height - 1) * std::uint64_t(view.row_pitch) +
                               std::uint64_t(view.layers - 1) * std::uint64_t(view.layer_pitch);
    if (last / 2 > UINT32_MAX)
      fail(resource.name, "texture " + quoted(resource.name) +
                              " takes more than 32 GiB, beyond which texels have no addresses: make it "
                              "smaller");
  }

  // Rows of large textures that no other layout has moved, where row_pitch says so.
  void move_rows_apart(TextureView& view) {
    const std::size_t row = std::size_t(view.width) * 4, pitch = row_pitch(row);
    const std::size_t rows = std::size_t(view.height) * std::size_t(view.layers);
    if (view.texel_pitch != 4 || std::size_t(view.row_pitch) == pitch || rows * row * sizeof(float) < kLargeTexture)
      return;
    AlignedArray<float>& to = draw_.laid_out.emplace_back(rows * pitch);
    parallel_for(rows, [&](std::size_t y, int) { std::copy_n(view.texels + y * row, row, &to[y * pitch]); });
    view.texels = to.data();
    view.row_pitch = std::ptrdiff_t(pitch);
    view.layer_pitch = view.row_pitch * view.height;
  }

  // Layers side by side at each texel, in whole cache lines of four, or two in half a line; the last one repeated at
  // the end. layers_read: as ShaderResource has it.
  void interleave(TextureView& view, std::uint32_t layers_read) {
    const auto all = std::size_t(view.layers);
    const std::size_t layers = layers_read == 0 ? all : std::min(all, std::size_t{layers_read});
    const std::size_t padded = layers == 2 ? 2 : (layers + 3) / 4 * 4;
    const std::size_t width = std::size_t(view.width), height = std::size_t(view.height);
    const std::size_t pitch = row_pitch(width * padded * 4);
    AlignedArray<float>& to = draw_.laid_out.emplace_back(height * pitch);
    parallel_for(height, [&](std::size_t y, int) {
      for (std::size_t layer = 0; layer < padded; ++layer) {
        const float* from = view.texels + std::ptrdiff_t(std::min(layer, layers - 1)) * view.layer_pitch +
                            std::ptrdiff_t(y) * view.row_pitch;
        for (std::size_t x = 0; x < width; ++x) std::copy_n(from + x * 4, 4, &to[y * pitch + (x * padded + layer) * 4]);
      }
    });
    view.texels = to.data();
    view.texel_pitch = std::ptrdiff_t(padded * 4);
    view.row_pitch = std::ptrdiff_t(pitch);
    view.layer_pitch = 4;
  }

  // RGB of layers side by side at each texel, five to a cache line, as LayerOrder::colors_together says; the last one
  // repeated in a last five of more than one. One that is left takes 32 bytes: no register of eight floats of the
  // others crosses a cache line then.
  void interleave_colors(TextureView& view) {
    const auto layers = std::size_t(view.layers);
    const std::size_t filled = layers % 5 == 1 ? layers : (layers + 4) / 5 * 5;
    const std::size_t texel = filled / 5 * 16 + filled % 5 * 8;
    const std::size_t width = std::size_t(view.width), height = std::size_t(view.height);
    const std::size_t pitch = row_pitch(width * texel);
    AlignedArray<float>& to = draw_.laid_out.emplace_back(height * pitch);
    parallel_for(height, [&](std::size_t y, int) {
      for (std::size_t layer = 0; layer < filled; ++layer) {
        const float* from = view.texels + std::ptrdiff_t(std::min(layer, layers - 1)) * view.layer_pitch +
                            std::ptrdiff_t(y) * view.row_pitch;
        for (std::size_t x = 0; x < width; ++x)
          std::copy_n(from + x * 4, 3, &to[y * pitch + x * texel + layer / 5 * 16 + layer % 5 * 3]);
      }
    });
    view.texels = to.data();
    view.texel_pitch = std::ptrdiff_t(texel);
    view.row_pitch = std::ptrdiff_t(pitch);
    view.layer_pitch = 3;
  }

  // Texels of two textures of one size side by side.
  void put_beside(TextureView& a, TextureView& b) {
    if (a.width != b.width || a.height != b.height || a.layers != b.layers) return;
    if (a.texel_pitch != 4 || b.texel_pitch != 4) return;
    const std::size_t row = std::size_t(a.width), rows = std::size_t(a.height) * std::size_t(a.layers);
    const std::size_t pitch = row_pitch(row * 8);
    AlignedArray<float>& to = draw_.laid_out.emplace_back(rows * pitch);
    parallel_for(rows, [&](std::size_t y, int) {
      for (std::size_t x = 0; x < row; ++x) {
        std::copy_n(a.texels + (y * row + x) * 4, 4, &to[y * pitch + x * 8]);
        std::copy_n(b.texels + (y * row + x) * 4, 4, &to[y * pitch + x * 8 + 4]);
      }
    });
    a.texels = to.data();
    b.texels = to.data() + 4;
    for (TextureView* view : {&a, &b}) {
      view->texel_pitch = 8;
      view->row_pitch = std::ptrdiff_t(pitch);
      view->layer_pitch = view->row_pitch * view->height;
    }
  }

  void find_texels_ahead() {
    for (std::uint32_t i = 0; i < module_.resource_count; ++i) {
      const ShaderResource& resource = module_.resources[i];
      if (resource.coordinates < 0) continue;
      const TextureView& view = draw_.textures[resource.slot];
      // Layers that lie together are part of the texel.
      const bool apart = view.layer_pitch > view.texel_pitch;
      const std::size_t bytes = std::size_t(view.width) * std::size_t(view.height) *
                                std::size_t(apart ? view.layers : 1) * std::size_t(view.texel_pitch) * sizeof(float);
      // Of texels with many layers that repeat a pixel reads more lines than it is worth asking for. Those of a pair
      // are asked for with the first one's.
      const bool too_many = view.wrap == Wrap::repeat && view.texel_pitch > 8;
      if (bytes < kLargeTexture || too_many || is_beside_another(resource)) continue;
      draw_.ahead.push_back({resource.slot, std::uint32_t(resource.coordinates), resource.layer});
    }
  }

  bool is_beside_another(const ShaderResource& resource) const {
    return std::any_of(module_.resources, module_.resources + module_.resource_count, [&](const ShaderResource& other) {
      return other.beside == std::int32_t(resource.slot) &&
             draw_.textures[resource.slot].texels == draw_.textures[other.slot].texels + 4;
    });
  }

  void choose_color() {
    if (module_.output_count == 0) return;
    const ShaderVariable* color = &module_.outputs[0];
    std::uint32_t element = 0;
    for (std::uint32_t i = 0; i < module_.output_count; ++i) {
      const ShaderVariable& output = module_.outputs[i];
      const std::int64_t behind = std::int64_t{output_} - output.location;
      if (output.location < 0 || behind < 0 || behind >= std::max(1u, output.array_length)) continue;
      color = &output;
      element = std::uint32_t(behind);
    }
    draw_.color_first = color->first_component + element * color->rows;
    draw_.color_components = color->rows;
    draw_.color_scalar = color->scalar;
  }

  const Bundle& bundle_;
  const ShaderModule& module_;
  const AttributeMode mode_;
  const std::uint32_t output_;  // location
  BoundDraw draw_;
};

}  // namespace

void BoundDraw::reset_buffers(const Bundle& bundle) {
  for (std::size_t slot = 0; slot < buffer_bytes.size(); ++slot) {
    const Buffer* buffer = bundle.find_buffer(buffer_names[slot]);
    if (buffer && buffer->storage) std::copy(buffer->bytes.begin(), buffer->bytes.end(), buffer_bytes[slot].begin());
  }
}

BoundDraw bind(const Bundle& bundle, const ShaderModule& module, AttributeMode mode, std::uint32_t output) {
  return Binder(bundle, module, mode, output).bind();
}

}  // namespace twinshade::tiled
