// The contract between a translated shader and whoever runs it: plain data and function pointers, no C++ types across a
// shared-object boundary. Changing anything here means raising kAbiVersion.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/endless_loop.h"
#include "bundle/bundle.h"

namespace twinshade {

inline constexpr std::uint32_t kAbiVersion = 10;

// What a piece of translated code was built for. The numbers are an order: a machine that has avx512 has all before it.
enum class Isa : std::uint8_t { baseline = 0, avx2 = 1, avx512 = 2 };  // baseline: x86-64-v2, or AArch64 with NEON
enum class Number : std::uint8_t { lanes4 = 0, lanes8 = 1, lanes16 = 2, scalar = 3, float64 = 4 };

struct ShaderVariable {  // an `in` or `out`
  const char* name;
  Scalar scalar;
  std::uint8_t columns, rows;  // vecN: columns 1, rows N
  std::uint32_t array_length;  // 0: not an array
  bool flat;
  bool noperspective;
  std::int32_t location;          // of an `out`: colour attachment; -1: not given
  std::uint32_t first_component;  // where it starts in ShadeCall::inputs or outputs; element-major, column-major
};

struct ShaderUniform {  // a leaf of a uniform outside any block: structs are flattened to "light.colour",
                        // "lights[2].colour"
  const char* name;
  Scalar scalar;
  std::uint8_t columns, rows;
  std::uint32_t array_length;                 // 0: not an array
  std::uint32_t offset;                       // bytes into ShaderData::uniforms
  std::uint32_t array_stride, matrix_stride;  // bytes
  const std::uint32_t* initial = nullptr;     // the initialiser's words, element-major, column-major; null: none
};

enum class ResourceKind : std::uint8_t { uniform_block, storage_buffer, sampler_2d, sampler_2d_array, sampler_cube };

// How the layers of an array texture should lie: one after another; all of a texel's side by side, RGBA; the same, but
// RGB alone, five layers to 16 floats, of which the last is not used, and where one layer is left in the end, that
// to 8.
enum class LayerOrder : std::uint8_t { apart, together, colors_together };

struct ShaderResource {
  const char* name;  // block name, or sampler name ("maps[2]" for an element of a sampler array)
  ResourceKind kind;
  std::uint32_t slot;          // index into ShaderData::textures or ::buffers
  std::uint32_t minimum_size;  // bytes that a block needs at least
  bool read_only;
  LayerOrder layer_order = LayerOrder::apart;
  // Sampler: slot of another whose texels are read together with this one's, if their sizes are equal.
  std::int32_t beside = -1;
  // Sampler that is read at coordinates which are an input: its first component, and that of the layer; -1: another
  // way. With -1 for the layer alone it is layer 0. A hint (TexelsAhead).
  std::int32_t coordinates = -1, layer = -1;
  // With LayerOrder::together: only the first so many layers are read, and others need not be there; 0: all.
  std::uint32_t layers_read = 0;
};

struct TextureView {    // RGBA32F
  const float* texels;  // texel (0,0) of layer 0
  std::int32_t width, height, layers;
  std::ptrdiff_t row_pitch, layer_pitch;  // floats; multiples of 4, as texel_pitch, but for LayerOrder::colors_together
  TextureKind kind;
  Filter filter;
  Wrap wrap;
  // Floats from texel x to x + 1. Above 4: layers of a texel lie side by side, layer_pitch 4; or, with layer_pitch
  // 3, as LayerOrder::colors_together says, which the served fetches of colours alone can read.
  std::ptrdiff_t texel_pitch = 4;
};

struct BufferView {
  std::byte* bytes;
  std::size_t size;
};

struct ShaderData {  // the same for all invocations of a draw
  const std::byte* uniforms;
  const TextureView* textures;
  const BufferView* buffers;
};

// A texture whose texels are worth asking for before they are read: too large for the caches, and read at an input's
// coordinates.
struct TexelsAhead {
  std::uint32_t texture;      // index into ShaderData::textures
  std::uint32_t coordinates;  // first component, in ShadeCall::inputs
  std::int32_t layer;         // component; -1: layer 0
};

// Where a block of compute invocations is: all of it in one work group.
struct ComputeCall {
  std::uint32_t group[3];        // gl_WorkGroupID
  std::uint32_t group_count[3];  // gl_NumWorkGroups
  std::uint32_t first;           // gl_LocalInvocationIndex of the block's first invocation
  std::byte* shared;             // ShaderModule::shared_bytes, the work group's own
  void (*barrier)(void*);        // returns when all invocations of the group have called it
  void* barrier_context;
};

// A block of fragment invocations. With derivatives, 4q .. 4q+3 are a quad: (x,y) (x+1,y) (x,y+1) (x+1,y+1), x and y
// even. count is a multiple of 16; pad with dead ones (live = 0, any finite inputs). Arrays are structures of arrays:
// component c of invocation i is at [c * stride + i]; 64-byte aligned, stride a multiple of 16. "real" is float, or
// double for Number::float64. In a float array integers are bit patterns; in a double array they are their value, and
// so are booleans (0 or 1).
struct ShadeCall {
  std::uint32_t count;
  std::uint32_t stride;
  const void* inputs;                 // real; in order of ShaderVariable::first_component
  const void* frag_coord;             // real; 4 components
  const std::uint32_t* live;          // ~0u: covered; 0: helper (runs for derivatives, writes nothing)
  const std::uint32_t* front_facing;  // ~0u or 0
  const std::uint32_t* primitive_id;
  void* outputs;        // real; helpers and discarded invocations leave theirs undefined
  void* frag_depth;     // real; written only if the shader writes gl_FragDepth
  std::uint32_t* kept;  // out: ~0u where live and not discarded
  void (*endless_loop)(const char* where) = stop_endless_loop;
  // Compute shaders only, whose count is a multiple of the lanes of their number type, and which use `live` and `kept`
  // alone of the above.
  const ComputeCall* compute = nullptr;
  const TexelsAhead* ahead = nullptr;  // the first eight are taken
  std::uint32_t ahead_count = 0;
};

using ShadeFunction = void (*)(const ShaderData&, const ShadeCall&);

struct ShaderEntry {
  Isa isa;
  Number number;
  ShadeFunction shade;
};

struct ShaderModule {
  std::uint32_t abi_version;
  const char* name;
  const char* source_hash;  // SHA-256 of the preprocessed GLSL (includes resolved)
  const ShaderVariable* inputs;
  std::uint32_t input_count, input_components;
  const ShaderVariable* outputs;
  std::uint32_t output_count, output_components;
  const ShaderUniform* uniforms;
  std::uint32_t uniform_count, uniform_bytes;
  const ShaderResource* resources;
  std::uint32_t resource_count, texture_count, buffer_count;
  bool discards, writes_depth, has_side_effects, uses_derivatives, uses_frag_coord, uses_front_facing,
      uses_primitive_id, uses_helper_invocation;
  const char* no_float64_reason;  // null, or why there is no float64 entry ("file:line: floatBitsToInt ...")
  const ShaderEntry* entries;
  std::uint32_t entry_count;
  std::uint32_t local_size[3] = {0, 0, 0};  // of a compute shader; zeros: a fragment shader
  std::uint32_t shared_bytes = 0;
  bool uses_barrier = false;
};

// Every shared object made from a user's shader exports this symbol.
inline constexpr const char* kModuleSymbol = "twinshade_shader_module";

}  // namespace twinshade
