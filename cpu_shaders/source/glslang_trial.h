// glslang 12 crashes on some input (docs/hardening.md) and sets itself no limits. A shader that looks as if it could
// make it do so goes through it first in a child process, with limits of time and memory, whose end nobody else
// notices.
#pragma once

#include <functional>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// Whether a shader is long, deeply nested or full of macros.
bool looks_hostile(const ShaderSource& source);

// Runs `work` in a child process; exceptions in it are its own affair. UserError naming the shader's main file where
// the child crashed or met a limit. Costs some milliseconds.
void try_in_child(const ShaderSource& source, const std::function<void()>& work);

}  // namespace twinshade
