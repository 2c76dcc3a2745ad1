// The shader's surface: inputs, outputs, uniforms, textures and buffers, with the C++ names that they get.
#pragma once

#include "cpu_shaders/translate/function_info.h"
#include "cpu_shaders/translate/layout.h"
#include "cpu_shaders/translate/names.h"
#include "cpu_shaders/translate/source_lines.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade::spirv {

enum class Role { input, builtin, output, frag_depth, global, uniform, sampler, buffer, shared };

struct Global {
  Role role = Role::global;
  std::string name;  // in C++
  Id type = 0;
  spv::BuiltIn builtin = spv::BuiltInMax;
  std::uint32_t first_component = 0;
  std::uint32_t slot = 0;    // samplers, blocks
  std::uint32_t offset = 0;  // uniforms outside blocks, shared variables
  bool mentioned = false;    // by a function that main reaches
  bool in_block = false;     // a uniform block small enough to be loaded once, before all invocations
};

struct Interface {
  std::map<Id, Global> globals;
  Reflection reflection;
};

// UserError for what cannot be bound: other sampler types, images ...
Interface describe_interface(const Program& program, const SourceLines& lines, NameTable& names);

}  // namespace twinshade::spirv
