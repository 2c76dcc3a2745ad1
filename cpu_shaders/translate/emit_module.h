// The whole C++ file.
#pragma once

#include "cpu_shaders/translate/instances.h"
#include "cpu_shaders/translate/interface.h"

namespace twinshade::spirv {

// Completes translation.reflection (no_float64_reason) and writes translation.cpp.
void emit_module(const Program& program, Interface& interface, const SourceLines& lines, NameTable& names,
                 const ShaderSource& source, const TranslateOptions& options, Translation& translation);

}  // namespace twinshade::spirv
