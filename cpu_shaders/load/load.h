// From GLSL to code that runs: built-in shaders are compiled into the binary, others are translated, compiled with the
// system's compiler, cached on disk by content and loaded.
#pragma once

#include <optional>
#include <string>

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// A module that has code for `number`, for instruction sets up to `isa` (unset: this machine's best). Built-in where the
// source's hash is that of a built-in shader, so a changed shader never gets stale code, and where the binary holds the number
// type asked for: 8 and 16 lanes on registers of 4 are compiled on demand. The reference stays valid until the process ends. Safe from several threads and processes.
// UserError: GLSL that is wrong or not supported (file and line), an instruction set that the machine lacks, no compiler.
const ShaderModule& load_module(const ShaderSource& source, Number number, std::optional<Isa> isa = {});

// The built-in module of a source, null where it is not built in.
const ShaderModule* find_builtin_module(const ShaderSource& source);

// Compiles a translation to a shared object in the cache (or finds it there) and returns its path.
// compiler: empty for the first of $CXX, clang++, g++, c++ that is there.
std::string compile_shader(const std::string& cpp, Isa isa, Number number, const std::string& compiler = {});

}  // namespace twinshade
