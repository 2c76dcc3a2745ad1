// What a function reads, writes and calls: facts that hold however it is called.
#pragma once

#include <map>
#include <set>
#include <unordered_map>

#include "cpu_shaders/translate/structure.h"

namespace twinshade::spirv {

struct FunctionInfo {
  Function* function = nullptr;
  Body body;

  std::unordered_map<Id, const Instruction*> definitions;
  std::unordered_map<Id, int> uses;  // of values and pointers, by instructions, conditions and returns
  std::vector<Id> locals;            // variables, in order of first use

  // Parameters that are pointers (glslang passes all but `const in` so): by index.
  std::set<std::size_t> written_parameters;     // the function stores through it
  std::set<std::size_t> read_first_parameters;  // its value on entry matters
  std::set<std::size_t> returned_parameters;    // some caller reads it after the call: out or inout
  bool is_reference(std::size_t parameter) const {
    return written_parameters.count(parameter) && returned_parameters.count(parameter);
  }
  Id parameter_type(const Module& module, std::size_t parameter) const;  // of the value
  // Structures and arrays that the function only reads are the caller's own.
  bool passed_uncopied(const Module& module, std::size_t parameter) const;

  std::set<Id> globals_read, globals_written;  // private and output variables, callees' included
  bool mask_matters = false;                   // it has control flow or effects, or calls what has
  bool discards = false, writes_buffers = false, reads_buffers = false, uses_derivatives = false, has_barrier = false;

  // Local variables that are stored once, whole, with a constant, and only read: constant tables.
  std::map<Id, Id> constant_tables;
  // Local variables made to pass an argument that the function does not give back: the value stands for them.
  std::set<Id> argument_temporaries;

  std::map<Id, std::string> parameter_of;  // name of the parameter that a variable is passed for

  // Loops that count their iterations while they run, by statement id: what an iteration costs.
  std::map<int, std::uint32_t> counted_loops;
  std::uint64_t work = 0;  // iterations of the other loops and calls, of one call

  // A call can stand anywhere in an expression.
  bool pure() const;
};

// The variable or parameter that a pointer points into.
Id root_of(const FunctionInfo& info, Id pointer);

struct Program {
  Module module;
  std::map<Id, FunctionInfo> functions;
  std::vector<Id> callees_first;  // reachable from main, main last

  const FunctionInfo& info(Id function) const { return functions.at(function); }
};

// Structures every reachable function, folds conditional expressions and gathers the facts, liveness included.
Program analyse(Module module);

// Before all else: conversions that glslang leaves out. UserError for what it makes no sense of.
void complete_struct_copies(Module& module, Function& function);

// Before what follows: peephole.cpp.
void simplify(Module& module, Function& function);

// Turns  if (c) t = a; else t = b;  with pure a and b into t = select(c, a, b), where t is glslang's own temporary (the
// form that ?:, && and || arrive in), and two pure returns into one.
void fold_conditionals(Module& module, Body& body);

// Fills FunctionInfo::counted_loops and work; those of the functions that it calls are known. UserError for too many calls.
void find_endless_loops(const Program& program, FunctionInfo& info);

// Fills the live_* sets of the tree.
void compute_liveness(Program& program, FunctionInfo& info);

}  // namespace twinshade::spirv
