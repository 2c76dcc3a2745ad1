// Which out and inout arguments can be the caller's own variables. SPIR-V copies them into temporaries before a call
// and back after it.
#pragma once

#include "cpu_shaders/translate/instances.h"

namespace twinshade::spirv {

struct DirectArguments {
  std::map<Id, Id> variable;             // of a temporary: what it stands for
  std::set<const Instruction*> skipped;  // the copies

  static DirectArguments find(const Program& program, const Instances& instances, const Instance& instance);
};

}  // namespace twinshade::spirv
