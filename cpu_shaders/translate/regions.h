// Where each local variable is declared: SPIR-V declares them all at the top of the function, C++ as late as it can.
#pragma once

#include "cpu_shaders/translate/direct_arguments.h"

namespace twinshade::spirv {

struct Regions {
  std::set<const Instruction*> declaring_stores;                     // the variable begins here, with its value
  std::map<const Statement*, std::vector<Id>> before;                // declared without a value before this statement
  std::map<const Instruction*, std::vector<Id>> before_instruction;  // the same, within straight code
  std::map<const Statement*, const Instruction*> loop_init;          // the loop's own counter: declared in its head
  std::set<Id> constant;                                             // never written again

  // Depends on what the instance's stores may overwrite.
  static Regions find(const Program& program, const Instance& instance, const DirectArguments& direct);
};

}  // namespace twinshade::spirv
