// The translated shaders that hash_frame is linked with; the table is made by tests/aarch64/CMakeLists.txt.
#pragma once

#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

struct LinkedShader {
  const char* identifier;
  const ShaderModule* module;  // its own entries are unset
  const ShaderEntry* entries;
  std::uint32_t entry_count;
};

std::vector<LinkedShader> linked_shaders();

}  // namespace twinshade
