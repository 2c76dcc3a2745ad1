// SPIR-V as glslang writes it (unoptimised, structured, with debug lines), taken apart into tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#define SPV_ENABLE_UTILITY_CODE  // HasResultAndType
#include <glslang/SPIRV/spirv.hpp>

#include "cpu_shaders/translate/source_lines.h"

namespace twinshade::spirv {

using Id = std::uint32_t;

struct Instruction {
  spv::Op op = spv::OpNop;
  Id type = 0, result = 0;
  std::vector<std::uint32_t> operands;  // without type and result
  std::uint32_t file = 0;               // OpString
  int line = 0;

  bool is_chain() const { return op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain; }
};

struct Block {
  Id label = 0;
  std::vector<Instruction> code;  // without phis, merge and terminator
  std::vector<Instruction> phis;
  Instruction terminator;
  Id selection_merge = 0, loop_merge = 0, loop_continue = 0;
};

struct Parameter {
  Id id = 0, type = 0;
};

struct Function {
  Id id = 0, result_type = 0;
  std::string name;  // GLSL name, without the mangled parameter types
  std::vector<Parameter> parameters;
  std::vector<Block> blocks;
  std::uint32_t file = 0;
  int line = 0;
};

enum class Kind {
  none,
  boolean,
  integer,
  unsigned_integer,
  real,
  vector,
  matrix,
  array,
  runtime_array,
  structure,
  pointer,
  image,
  sampler
};

struct Type {
  Kind kind = Kind::none;
  Id element = 0;           // vector: scalar; matrix: column; array; pointer: pointee; sampler: its image
  std::uint32_t count = 0;  // vector, matrix, array
  std::vector<Id> members;
  spv::StorageClass storage = spv::StorageClassFunction;
  spv::Dim dimension = spv::Dim2D;
  bool arrayed = false, depth = false, multisampled = false, storage_image = false;
};

struct Constant {
  Id type = 0;
  std::uint32_t bits = 0;      // scalars; bool: 0 or 1
  std::vector<Id> components;  // composites
};

struct Variable {
  Id id = 0, type = 0;  // type: of the pointee
  spv::StorageClass storage = spv::StorageClassFunction;
  Id initializer = 0;
};

struct Decorations {
  std::map<spv::Decoration, std::uint32_t> values;
  bool has(spv::Decoration d) const { return values.count(d) != 0; }
  std::uint32_t get(spv::Decoration d, std::uint32_t otherwise = 0) const {
    const auto found = values.find(d);
    return found == values.end() ? otherwise : found->second;
  }
};

struct Module {
  std::unordered_map<Id, Type> types;
  std::unordered_map<Id, Constant> constants;
  std::unordered_map<Id, Variable> variables;  // global and local
  std::unordered_map<Id, std::string> names, strings;
  std::unordered_map<Id, Decorations> decorations;
  std::map<std::pair<Id, std::uint32_t>, Decorations> member_decorations;
  std::map<std::pair<Id, std::uint32_t>, std::string> member_names;
  std::unordered_map<Id, Id> value_types;  // type of every result
  std::vector<Id> globals;                 // in order of declaration
  std::vector<Function> functions;
  Id entry = 0;
  Id bound = 0;  // every id is smaller
  bool depth_replacing = false, early_tests = false, other_frag_coord = false;
  std::uint32_t local_size[3] = {0, 0, 0};  // of a compute shader

  const Type& type(Id id) const { return types.at(id); }
  const Type& type_of(Id value) const { return types.at(value_types.at(value)); }
  bool is_constant(Id id) const { return constants.count(id) != 0; }
  const Function* function(Id id) const;
  std::string name(Id id) const;
  Position position(std::uint32_t file, int line) const;
  Position position(const Instruction& i) const { return position(i.file, i.line); }
  const Decorations& decorations_of(Id id) const;
  const Decorations& member(Id structure, std::uint32_t index) const;

  Id new_id() { return bound++; }

  // "[0][0]", "[0][1]" ... for the elements of an array of arrays, in order; one empty text for what is no array.
  std::vector<std::string> element_suffixes(Id type) const;
  // What an array, or array of arrays, is made of; the type itself if it is none.
  Id innermost(Id type) const {
    return this->type(type).kind == Kind::array ? innermost(this->type(type).element) : type;
  }

  // Number of scalars in a type.
  std::uint32_t component_count(Id type) const;
  // The scalar that a scalar, vector or matrix is made of.
  Kind scalar_kind(Id type) const;
};

// UserError for what a type or an instruction at module level cannot mean to us (64-bit numbers, for instance).
Module parse(const std::vector<std::uint32_t>& words, const SourceLines& lines);

// "OpFAdd": for messages.
std::string op_name(spv::Op op);

// Ids of values that an instruction reads (labels, literals and type ids left out).
std::vector<Id> value_operands(const Instruction& instruction);

}  // namespace twinshade::spirv
