// Which of a module's entries runs.
#pragma once

#include <optional>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade::tiled {

const char* isa_name(Isa isa);
const char* number_name(Number number);

// The entry for `number` with the best instruction set up to `isa` (unset: up to the machine's). With no instruction
// set asked for, 16 lanes mean as many as the machine's registers hold. UserError where there is none.
const ShaderEntry& choose_entry(const ShaderModule& module, Number number, std::optional<Isa> isa);

}  // namespace twinshade::tiled
