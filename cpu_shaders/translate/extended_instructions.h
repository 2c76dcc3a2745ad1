// GLSL.std.450: the built-in functions that reach us as extended instructions.
#pragma once

#include <cstdint>

namespace twinshade::spirv {

struct ExtendedInstruction {
  std::uint32_t number;
  const char* glsl;      // in messages
  const char* function;  // in namespace glsl of the runtime; null: refused
  const char* remedy;    // where refused
  bool bits;             // looks at the bits of a float: not in double
};

const ExtendedInstruction* extended_instruction(std::uint32_t number);

}  // namespace twinshade::spirv
