// Which functions of a shader the runtime serves by equivalents of its own: those of shaders/exact/ in
// runtime/served_names.h.
#pragma once

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {

bool is_served(const Module& module, const Function& function);

// Functions of numbers alone are served in double: their bit casts never run there.
bool is_served_in_double(const Module& module, const Function& function);

}  // namespace twinshade::spirv
