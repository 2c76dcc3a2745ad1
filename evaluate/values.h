// Tables of typed values: what a shader is given and what it computed, one row an invocation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bundle/bundle.h"

namespace twinshade {

struct ValueType {
  Scalar scalar = Scalar::f32;
  std::uint32_t columns = 1, rows = 1;  // vecN: columns 1, rows N
  std::uint32_t array_length = 0;       // 0: not an array

  std::uint32_t components() const { return columns * rows * (array_length == 0 ? 1 : array_length); }
  bool operator==(const ValueType&) const = default;
};

// As GLSL spells it: "float", "ivec2", "mat3", "mat4x3", "vec3[5]".
std::string type_name(const ValueType& type);
// nothing: no type of values. "mat3x3" is mat3; array lengths 1 to 65536.
std::optional<ValueType> find_type(std::string_view name);

// "v[2].y" for a component of a variable; matrices by column: "m[1].z".
std::string component_name(const std::string& variable, const ValueType& type, std::uint32_t component);

// Values of one input, uniform or output.
struct Values {
  std::string name;
  ValueType type;
  // [row * type.components() + component]; arrays element by element, matrices column by column. Floats and ints by bit
  // pattern, bool 0 or 1.
  std::vector<std::uint32_t> bits;
  // Outputs of Number::float64 only: the same values unrounded (bits then hold them rounded to float). Else empty.
  std::vector<double> doubles;

  std::size_t row_count() const { return bits.size() / type.components(); }
};

// As a number: an int's or uint's value, a float widened, the unrounded double where there is one.
double value_at(const Values& values, std::size_t row, std::uint32_t component);

struct ValueTable {
  std::size_t rows = 0;        // 1 to kMostTableRows
  std::vector<Values> inputs;  // `rows` rows each
  // By GLSL path: "tint", "weights" (a whole array), "lights[2].colour", "Block.member" or "member" of a uniform block.
  // One row for all invocations, or `rows` rows.
  std::vector<Values> uniforms;
  std::vector<Texture> textures;  // by sampler name
  std::vector<Buffer> buffers;    // storage buffers, and uniform blocks given as bytes
  std::string origin = {};        // the file that it was read from, which messages blame; empty: none
};

inline constexpr std::size_t kMostTableRows = 1048576;

// What a shader computed.
struct EvaluatedRows {
  std::vector<Values> outputs;     // in the order of Reflection::outputs, then gl_FragDepth where the shader writes it
  std::vector<std::uint8_t> kept;  // by row: 0 where the shader discarded; outputs are 0 there
  std::vector<std::pair<std::string, std::string>> provenance;  // GL_RENDERER, isa ...
};

const Values* find_values(const std::vector<Values>& list, std::string_view name);

}  // namespace twinshade
