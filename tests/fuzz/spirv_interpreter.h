// A plain interpreter of SPIR-V: one invocation, one instruction at a time, branches as jumps. It follows the text of
// the SPIR-V specification (Khronos, 1.0) and of docs/generated-code.md where that leaves a result open, and knows
// nothing of the translator: the third opinion where the CPU and a driver differ.
#pragma once

#include <map>
#include <stdexcept>

#include "tests/fuzz/spirv_program.h"

namespace twinshade::fuzz {

// An instruction that the interpreter does not know, or too many steps.
class CannotInterpret : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Invocation {
  bool discarded = false;
  std::map<std::string, Words> outputs;  // empty if discarded
  std::uint64_t steps = 0;
};

class Interpreter {
 public:
  explicit Interpreter(const std::vector<std::uint32_t>& spirv);

  // `values`: inputs and uniforms outside blocks by name; those without a value are 0. The caller decides whether
  // denormals are flushed (FlushDenormals), as for translated shaders.
  Invocation run(const std::map<std::string, Words>& values, std::uint64_t most_steps = 10'000'000);

 private:
  struct Pointer {
    Words* words = nullptr;
    std::size_t offset = 0;
  };
  struct Discarded {};

  Words call(Id function, const std::vector<std::uint32_t>& arguments);
  void execute(const Instruction& i);
  bool memory(const Instruction& i);
  bool composite(const Instruction& i);
  bool arithmetic(const Instruction& i);
  void extended(const Instruction& i);
  void declare(const Instruction& variable);
  std::pair<std::size_t, Id> part(Id type, std::uint32_t index) const;
  const Words& value(Id id) const { return program_.constants[id].empty() ? values_[id] : program_.constants[id]; }

  // Ids are unique in the module and recursion is not allowed: each has one value at a time.
  Program program_;
  std::vector<Words> values_;
  std::vector<Words> variables_;
  std::vector<Pointer> pointers_;
  std::uint64_t steps_ = 0, most_steps_ = 0;
};

// What scalar instructions mean: op (or GLSL.std.450's number, see `extended_scalar`) of one component each.
bool scalar_operation(spv::Op op, const std::uint32_t* x, std::size_t count, std::uint32_t& result);
bool extended_scalar(std::uint32_t number, const std::uint32_t* x, std::uint32_t& result);

}  // namespace twinshade::fuzz
