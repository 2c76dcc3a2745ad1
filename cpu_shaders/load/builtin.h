// What the build generates: a list of the modules compiled into this binary.
#pragma once

#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

struct BuiltinEntries {
  const ShaderEntry* entries;
  std::uint32_t count;
};

struct BuiltinModule {
  const ShaderModule* module;          // of the baseline object; its own entries are unset
  std::vector<BuiltinEntries> parts;   // one per instruction set
};

std::vector<BuiltinModule> builtin_modules();

}  // namespace twinshade
