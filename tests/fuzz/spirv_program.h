// SPIR-V of a fragment shader, read for the interpreter. Shares nothing with the translator's own reader: the two are
// to check each other.
#pragma once

#include <glslang/SPIRV/spirv.hpp>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace twinshade::fuzz {

using Id = std::uint32_t;

// The scalars of a value, one word each: elements, members, columns, components in order. A bool is 0 or 1.
using Words = std::vector<std::uint32_t>;

struct Instruction {
  spv::Op op = spv::OpNop;
  Id type = 0, result = 0;
  std::vector<std::uint32_t> operands;  // without type and result
};

struct Type {
  spv::Op op = spv::OpTypeVoid;
  bool is_signed = false;
  spv::StorageClass storage = spv::StorageClassFunction;
  std::vector<Id> parts;    // struct: members; vector, matrix, array, pointer: the one that it is made of
  std::uint32_t count = 1;  // of parts in a vector, matrix or array
  std::uint32_t words = 0;  // size
};

struct Function {
  std::vector<Id> parameters;
  std::vector<Instruction> code;  // labels included
};

struct Program {
  std::vector<Type> types;  // by id
  std::vector<Words> constants;
  std::vector<Id> value_types;
  std::unordered_map<Id, std::string> names;
  std::vector<Instruction> globals;  // OpVariable
  std::unordered_map<Id, Function> functions;
  std::unordered_map<Id, std::size_t> labels;  // index into the code of their function
  Id entry = 0, bound = 0;

  const Type& type_of(Id value) const { return types[value_types[value]]; }
  // float, int, uint or bool: what the value is made of.
  const Type& scalar_of(Id type) const;
};

// Throws std::runtime_error for what is not SPIR-V.
Program read_program(const std::vector<std::uint32_t>& words);

}  // namespace twinshade::fuzz
