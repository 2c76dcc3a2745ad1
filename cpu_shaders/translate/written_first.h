// Which globals and outputs need no value to begin with: those that the shader writes, whole and in all lanes, before
// it reads them.
#pragma once

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {

bool is_written_first(const Program& program, Id global);

}  // namespace twinshade::spirv
