#include "raster/gl/worker/draw_data.h"

#include <algorithm>
#include <bit>

#include "bundle/uniform_text.h"
#include "raster/gl/extended_products.h"
#include "raster/gl/generated_shaders.h"
#include "raster/gl/worker/failure.h"
#include "raster/gl/worker/uniform_type.h"

namespace twinshade::gl {
namespace {

template <class List>
auto find_named(const List& list, const std::string& name) {
  auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.name == name; });
  return found == list.end() ? nullptr : &*found;
}

template <class List>
std::string names_of(const List& list) {
  std::string names;
  for (const auto& item : list) names += (names.empty() ? "" : ", ") + item.name;
  return names.empty() ? "none" : names;
}

[[noreturn]] void missing(const std::string& what, const std::string& present) {
  throw Failure(Outcome::user_error, what + " is not in the bundle, which has: " + present);
}

GLenum target_of(TextureKind kind) {
  return kind == TextureKind::two_d         ? GL_TEXTURE_2D
         : kind == TextureKind::two_d_array ? GL_TEXTURE_2D_ARRAY
                                            : GL_TEXTURE_CUBE_MAP;
}

const char* sampler_text(TextureKind kind) {
  return kind == TextureKind::two_d ? "sampler2D" : kind == TextureKind::two_d_array ? "sampler2DArray" : "samplerCube";
}

void set_sampling(const GlFunctions& gl, GLenum target, GLint filter, GLint wrap) {
  gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl.TexParameteri(target, axis, wrap);
  gl.TexParameteri(target, GL_TEXTURE_BASE_LEVEL, 0);
  gl.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}

// `size` bytes, then zeros up to `capacity`. A store of no bytes cannot be bound, so none is.
void fill_buffer(const GlFunctions& gl, GLuint name, const std::byte* bytes, std::uint64_t size,
                 std::uint64_t capacity) {
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, name);
  if (size == capacity && size != 0) {
    gl.BufferData(GL_COPY_WRITE_BUFFER, GLsizeiptr(size), bytes, GL_STATIC_DRAW);
    return;
  }
  const std::vector<std::byte> zeros(std::max<std::uint64_t>(capacity, 16));
  gl.BufferData(GL_COPY_WRITE_BUFFER, GLsizeiptr(zeros.size()), zeros.data(), GL_STATIC_DRAW);
  gl.BufferSubData(GL_COPY_WRITE_BUFFER, 0, GLsizeiptr(size), bytes);
}

// Drivers report the size of a block rounded up to the alignment of a vec4.
std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 15) / 16 * 16; }

}  // namespace

DrawData::DrawData(const GlFunctions& gl) : gl_(gl) {
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.BindVertexArray(vertex_array_);
  gl_.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_buffer_texels_);
  for (GLuint* view : {&position_view_, &vertex_view_, &index_view_}) gl_.GenTextures(1, view);
}

void DrawData::replace(ImageIndex index, SharedMemory memory) {
  for (auto& [name, texture] : textures_) gl_.DeleteTextures(1, &texture);
  for (auto& [name, buffer] : buffers_) gl_.DeleteBuffers(1, &buffer);
  textures_.clear(), buffers_.clear(), written_.clear();
  for (GLuint* buffer : {&vertices_, &indices_, &drawn_indices_}) {
    if (*buffer != 0) gl_.DeleteBuffers(1, buffer);
    gl_.GenBuffers(1, buffer);
  }
  index_ = std::move(index);
  memory_ = std::move(memory);
  fill_buffer(gl_, vertices_, memory_.data() + index_.vertices, index_.vertex_floats * 4, index_.vertex_floats * 4);
  fill_buffer(gl_, indices_, memory_.data() + index_.indices, index_.index_count * 4, index_.index_count * 4);
  fill_buffer(gl_, drawn_indices_, memory_.data() + index_.drawn_indices, index_.index_count * 4,
              index_.index_count * 4);
  view_buffer(position_view_, GL_RGBA32UI, vertices_);
  view_buffer(vertex_view_, GL_R32UI, vertices_);
  view_buffer(index_view_, GL_R32UI, indices_);
  check_errors(gl_, "uploading vertices");
}

void DrawData::view_buffer(GLuint view, GLenum format, GLuint buffer) {
  gl_.BindTexture(GL_TEXTURE_BUFFER, view);
  gl_.TexBuffer(GL_TEXTURE_BUFFER, format, buffer);
}

void DrawData::bind_view(GLint location, GLuint view, std::uint64_t texels) {
  if (texels > std::uint64_t(most_buffer_texels_))
    throw std::runtime_error(std::to_string(texels) +
                             " numbers of vertex data or indices are more than the driver's buffer textures hold (" +
                             std::to_string(most_buffer_texels_) + ")");
  bind_unit(location, GL_TEXTURE_BUFFER, view);
}

void DrawData::set_cpu_pixels(std::uint32_t width, std::uint32_t height, std::uint32_t components, const std::byte* ids,
                              const std::byte* attributes) {
  for (GLuint* texture : {&cpu_ids_, &cpu_attributes_}) {
    if (*texture != 0) gl_.DeleteTextures(1, texture);
    gl_.GenTextures(1, texture);
  }
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (ids != nullptr) {
    gl_.BindTexture(GL_TEXTURE_2D, cpu_ids_);
    set_sampling(gl_, GL_TEXTURE_2D, GL_NEAREST, GL_CLAMP_TO_EDGE);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, GLsizei(width), GLsizei(height), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                   ids);
  }
  if (components != 0) {
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, cpu_attributes_);
    set_sampling(gl_, GL_TEXTURE_2D_ARRAY, GL_NEAREST, GL_CLAMP_TO_EDGE);
    gl_.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R32UI, GLsizei(width), GLsizei(height), GLsizei(components), 0,
                   GL_RED_INTEGER, GL_UNSIGNED_INT, attributes);
  }
  check_errors(gl_, "uploading the CPU's attributes");
}

const ImageAttribute& DrawData::attribute(const std::string& name) const {
  const ImageAttribute* found = find_named(index_.attributes, name);
  if (found == nullptr) missing("input " + name, names_of(index_.attributes));
  return *found;
}

void DrawData::bind_geometry(const DrawRequest& request) {
  gl_.BindVertexArray(vertex_array_);
  for (; enabled_attributes_ > 0; --enabled_attributes_) gl_.DisableVertexAttribArray(enabled_attributes_ - 1);
  if (request.geometry == Geometry::full_screen || request.geometry == Geometry::rows) return;
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, drawn_indices_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.EnableVertexAttribArray(0);
  enabled_attributes_ = 1;
  if (request.geometry != Geometry::attributes) return;
  for (const InputLeaf& leaf : request.leaves) {
    const GLuint location = enabled_attributes_++;
    const void* offset = reinterpret_cast<const void*>(attribute(leaf.name).first * 4);
    if (leaf.scalar == Scalar::f32)
      gl_.VertexAttribPointer(location, GLint(leaf.components), GL_FLOAT, GL_FALSE, 0, offset);
    else
      gl_.VertexAttribIPointer(location, GLint(leaf.components), leaf.scalar == Scalar::i32 ? GL_INT : GL_UNSIGNED_INT,
                               0, offset);
    gl_.EnableVertexAttribArray(location);
  }
}

void DrawData::bind(const Program& program, const DrawRequest& request) {
  gl_.UseProgram(program.id());
  next_unit_ = 0;
  seamless_.reset();
  for (const ActiveUniform& uniform : program.uniforms()) {
    if (bind_own_uniform(uniform, request)) continue;
    if (uniform_type(uniform.type))
      bind_uniform(uniform, request);
    else
      bind_sampler(uniform);
  }
  GLuint binding = 0;
  for (const ActiveBlock& block : program.uniform_blocks()) {
    bind_buffer(block, false, binding);
    gl_.UniformBlockBinding(program.id(), block.index, binding++);
  }
  binding = 0;
  for (const ActiveBlock& block : program.storage_blocks()) {
    if (block.name == kPositionBlock)
      gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, vertices_);
    else if (block.name == kIndexBlock)
      gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, indices_);
    else
      bind_buffer(block, true, binding);
    gl_.ShaderStorageBlockBinding(program.id(), block.index, binding++);
  }
  check_errors(gl_, "binding uniforms and buffers");
}

bool DrawData::bind_own_uniform(const ActiveUniform& uniform, const DrawRequest& request) {
  if (uniform.name.rfind(kPrefix, 0) != 0) return false;
  if (uniform.name == kCpuIds) {
    bind_unit(uniform.location, GL_TEXTURE_2D, cpu_ids_);
  } else if (uniform.name == kCpuAttributes) {
    bind_unit(uniform.location, GL_TEXTURE_2D_ARRAY, cpu_attributes_);
  } else if (uniform.name == kPositions) {
    bind_view(uniform.location, position_view_, index_.vertex_count);
  } else if (uniform.name == kVertexData) {
    bind_view(uniform.location, vertex_view_, index_.vertex_floats);
  } else if (uniform.name == kIndices) {
    bind_view(uniform.location, index_view_, index_.index_count);
  } else if (uniform.name == kNdcScale) {
    gl_.Uniform2f(uniform.location, 2.0f / float(std::bit_ceil(request.width)),
                  2.0f / float(std::bit_ceil(request.height)));
  } else if (uniform.name == kBases) {
    std::vector<GLint> bases;
    for (const InputLeaf& leaf : request.leaves) bases.push_back(GLint(attribute(leaf.name).first));
    gl_.Uniform1iv(uniform.location, std::min(uniform.size, GLint(bases.size())), bases.data());
  } else if (uniform.name != kUnknownZero) {  // which is 0 from the start
    return false;
  }
  return true;
}

void DrawData::bind_uniform(const ActiveUniform& uniform, const DrawRequest& request) {
  const UniformType type = *uniform_type(uniform.type);
  const std::string wanted = "uniform " + uniform.name + " (" + type_text(type.scalar, type.columns, type.rows) + ")";
  const UniformValue* value = find_named(request.uniforms, uniform.name);
  if (value == nullptr) value = find_named(request.uniforms, uniform.name + "[0]");
  if (value == nullptr) {
    // The shader's own value: nothing else is ever set in this program, see ProgramCache.
    const std::string variable = uniform.name.substr(0, uniform.name.find_first_of(".["));
    const auto& own = request.initialized;
    if (std::find(own.begin(), own.end(), variable) != own.end()) return;
    missing(wanted,
            names_of(request.uniforms) + "; it has no initial value: " +
                initial_value_remedy(uniform.name, type.scalar, type.columns, type.rows, uniform.array ? 1 : 0));
  }
  if (value->scalar != type.scalar || value->columns != type.columns || value->rows != type.rows)
    throw Failure(Outcome::user_error,
                  wanted + " is " + type_text(value->scalar, value->columns, value->rows) + " in the bundle");
  // The compiler may have cut the array down to the elements that are used.
  const std::uint32_t elements = std::max(value->array_length, 1u);
  if (std::uint32_t(uniform.size) > elements || uniform.array != (value->array_length != 0))
    throw Failure(
        Outcome::user_error,
        wanted +
            (uniform.array ? " is an array of at least " + std::to_string(uniform.size) : std::string(" is no array")) +
            ", but has " + std::to_string(value->array_length) + " array elements in the bundle");
  set_uniform(gl_, uniform.location, type, uniform.size, value->values.data());
}

void DrawData::bind_unit(GLint location, GLenum target, GLuint name) {
  gl_.ActiveTexture(GL_TEXTURE0 + GLenum(next_unit_));
  gl_.BindTexture(target, name);
  gl_.Uniform1i(location, next_unit_++);
}

// Whether texture() goes on across the edges of a cube map (Wrap::repeat) is a state of the whole context.
void DrawData::filter_edges(const ImageTexture& cube) {
  const bool seamless = cube.wrap == Wrap::repeat;
  if (seamless_ && *seamless_ != seamless)
    throw Failure(Outcome::user_error, "samplerCube " + cube.name +
                                           " and another one of the shader do not wrap alike; give both the same wrap");
  seamless_ = seamless;
  (seamless ? gl_.Enable : gl_.Disable)(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void DrawData::bind_sampler(const ActiveUniform& uniform) {
  TextureKind kind;
  switch (uniform.type) {
    case GL_SAMPLER_2D:
      kind = TextureKind::two_d;
      break;
    case GL_SAMPLER_2D_ARRAY:
      kind = TextureKind::two_d_array;
      break;
    case GL_SAMPLER_CUBE:
      kind = TextureKind::cube;
      break;
    default:
      throw Failure(Outcome::user_error,
                    "uniform " + uniform.name +
                        " has a type that is not supported: use sampler2D, sampler2DArray or samplerCube");
  }
  // Elements of a sampler array have consecutive locations.
  for (GLint element = 0; element < uniform.size; ++element) {
    const std::string name = uniform.name + (uniform.array ? "[" + std::to_string(element) + "]" : "");
    const ImageTexture* found = find_named(index_.textures, name);
    if (found == nullptr) missing(std::string(sampler_text(kind)) + " " + name, names_of(index_.textures));
    if (found->kind != kind)
      throw Failure(Outcome::user_error, std::string(sampler_text(kind)) + " " + name + " is a " +
                                             sampler_text(found->kind) + " texture in the bundle");
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(next_unit_));  // where a new texture may be bound while it is filled
    const GLuint object = texture(*found);
    if (kind == TextureKind::cube) filter_edges(*found);
    bind_unit(uniform.location + element, target_of(kind), object);
  }
}

GLuint DrawData::texture(const ImageTexture& t) {
  GLuint& object = textures_[t.name];
  if (object != 0) return object;
  gl_.GenTextures(1, &object);
  const GLenum target = target_of(t.kind);
  gl_.BindTexture(target, object);
  set_sampling(gl_, target, t.filter == Filter::nearest ? GL_NEAREST : GL_LINEAR,
               t.wrap == Wrap::repeat && t.kind != TextureKind::cube ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  const std::byte* texels = memory_.data() + t.offset;
  const auto width = GLsizei(t.width), height = GLsizei(t.height);
  if (t.kind == TextureKind::two_d)
    gl_.TexImage2D(target, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, texels);
  else if (t.kind == TextureKind::two_d_array)
    gl_.TexImage3D(target, 0, GL_RGBA32F, width, height, GLsizei(t.layers), 0, GL_RGBA, GL_FLOAT, texels);
  else
    for (GLenum face = 0; face < 6; ++face)
      gl_.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT,
                     texels + std::size_t(face) * t.width * t.height * 16);
  check_errors(gl_, "uploading texture " + t.name + " (" + std::to_string(t.width) + "x" + std::to_string(t.height) +
                        "x" + std::to_string(t.layers) + ")");
  return object;
}

GLuint DrawData::buffer(const ImageBuffer& b) {
  GLuint& object = buffers_[(b.storage ? "storage " : "uniform ") + b.name];
  if (object != 0) return object;
  gl_.GenBuffers(1, &object);
  // A storage buffer keeps its size, which .length() of an unsized array shows.
  fill_buffer(gl_, object, memory_.data() + b.offset, b.size, b.storage ? b.size : rounded_up(b.size));
  check_errors(gl_, "uploading buffer " + b.name);
  return object;
}

void DrawData::bind_buffer(const ActiveBlock& block, bool storage, GLuint binding) {
  const std::string wanted = (storage ? "storage buffer " : "uniform block ") + block.name;
  const ImageBuffer* found = find_named(index_.buffers, block.name);
  if (found == nullptr || found->storage != storage) {
    std::vector<ImageBuffer> present;
    std::copy_if(index_.buffers.begin(), index_.buffers.end(), std::back_inserter(present),
                 [&](const ImageBuffer& b) { return b.storage == storage; });
    missing(wanted, names_of(present));
  }
  if (rounded_up(found->size) < std::uint64_t(block.bytes))
    throw Failure(Outcome::user_error, wanted + " needs " + std::to_string(block.bytes) + " bytes, but has " +
                                           std::to_string(found->size) + " in the bundle");
  gl_.BindBufferBase(storage ? GL_SHADER_STORAGE_BUFFER : GL_UNIFORM_BUFFER, binding, buffer(*found));
  if (storage) written_.insert(found->name);
}

void DrawData::restore_storage() {
  for (const std::string& name : written_)
    for (const ImageBuffer& b : index_.buffers)
      if (b.storage && b.name == name) {
        gl_.BindBuffer(GL_COPY_WRITE_BUFFER, buffer(b));
        gl_.BufferSubData(GL_COPY_WRITE_BUFFER, 0, GLsizeiptr(b.size), memory_.data() + b.offset);
      }
  written_.clear();
}

void DrawData::read_storage(std::byte* to) {
  for (const ImageBuffer& b : index_.buffers) {
    if (!b.storage) continue;
    gl_.BindBuffer(GL_COPY_WRITE_BUFFER, buffer(b));
    gl_.GetBufferSubData(GL_COPY_WRITE_BUFFER, 0, GLsizeiptr(b.size), to);
    to += (b.size + 63) / 64 * 64;
  }
  check_errors(gl_, "reading storage buffers back");
}

}  // namespace twinshade::gl
