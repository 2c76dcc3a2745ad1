// GLSL to C++: one fragment or compute shader becomes one C++ file in the form of docs/generated-code.md.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct TranslateOptions {
  std::string identifier;  // for symbols; empty: made from the source's name
  // Readable: each GLSL line as a comment above its C++. Otherwise #line directives, so that debuggers step through the
  // GLSL.
  bool readable = false;
  // Another shader's code serves this one, which differs in names alone: reflection and module, no class, no entries.
  bool code_elsewhere = false;
  // For tests that must notice a wrong translation: every SPIR-V instruction `first` is translated as if it were
  // `second`.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> planted_bug;
};

// Reflection with its own storage; ShaderVariable and the others (shader_abi.h) are views of the same facts.
struct ReflectedVariable {
  std::string name;
  Scalar scalar = Scalar::f32;
  std::uint8_t columns = 1, rows = 1;
  std::uint32_t array_length = 0;
  bool flat = false, noperspective = false;
  std::int32_t location = -1;
  std::uint32_t first_component = 0;
};
struct ReflectedUniform {
  std::string name;
  Scalar scalar = Scalar::f32;
  std::uint8_t columns = 1, rows = 1;
  std::uint32_t array_length = 0, offset = 0, array_stride = 0, matrix_stride = 0;
  std::vector<std::uint32_t> initial;  // words of the initialiser; empty: none
};
// A leaf of a uniform block, by the name that OpenGL gives it: "colour", or "Light.colour" (the block's name) where the
// block has an instance name.
struct ReflectedBlockMember {
  ReflectedUniform value;      // offset: from the start of the block
  std::uint32_t resource = 0;  // index into Reflection::resources
  std::string instance;        // of the block, "b" or "b[1]"; may be empty
  bool row_major = false;      // matrices: matrix_stride is then from row to row
};
struct ReflectedResource {
  std::string name;
  ResourceKind kind = ResourceKind::sampler_2d;
  std::uint32_t slot = 0, minimum_size = 0;
  bool read_only = true;
  LayerOrder layer_order = LayerOrder::apart;
  std::int32_t beside = -1;
  std::int32_t coordinates = -1, layer = -1;
  std::uint32_t layers_read = 0;
};

struct Reflection {
  std::vector<ReflectedVariable> inputs, outputs;
  std::vector<ReflectedUniform> uniforms;
  std::vector<ReflectedResource> resources;
  std::vector<ReflectedBlockMember> block_members;  // of uniform blocks
  std::uint32_t input_components = 0, output_components = 0, uniform_bytes = 0, texture_count = 0, buffer_count = 0;
  bool discards = false, writes_depth = false, has_side_effects = false, uses_derivatives = false,
       uses_frag_coord = false, uses_front_facing = false, uses_primitive_id = false, uses_helper_invocation = false;
  std::uint32_t local_size[3] = {0, 0, 0}, shared_bytes = 0;  // compute shaders
  bool uses_barrier = false;
  std::string no_float64_reason;  // empty: it can run in double
  // Of Precision::by_line: the lines, as messages name them, that compute or keep floats, one for each of kHalfLines.
  std::vector<std::pair<std::string, int>> half_lines;
};

// The uniform, an array of uint, of translations that are Precision::by_line: which lines are computed in half, where
// not 0. No name of GLSL's.
inline constexpr const char* kHalfLines = "half lines";

struct Translation {
  std::string cpp;
  std::string identifier;
  Reflection reflection;
};

// UserError, one line: glslang's own message with the author's file and line, or "file:line: construct X is not
// supported: remedy".
Translation translate(const ShaderSource& source, const TranslateOptions& options = {});

// The line that a translation of lower precision than full (ShaderSource) has beside that which all have.
inline constexpr const char* kHalfInclude = "#include \"cpu_shaders/runtime/half_lanes.h\"\n";

// A C identifier from any name.
std::string identifier_from(const std::string& name);

}  // namespace twinshade
