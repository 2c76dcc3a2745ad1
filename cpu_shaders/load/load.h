// From GLSL to code that runs: built-in shaders are compiled into the binary, others are translated, compiled with the
// system's compiler, cached on disk by content and loaded.
#pragma once

#include <optional>
#include <string>

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// A module that has code for `number`, for instruction sets up to `isa` (unset: this machine's best). Built-in where
// the source's hash is that of a built-in shader, so a changed shader never gets stale code, and where the binary holds
// the number type asked for: 8 and 16 lanes on registers of 4 are compiled on demand. The reference stays valid until
// the process ends. Safe from several threads and processes. UserError: GLSL that is wrong or not supported (file and
// line), an instruction set that the machine lacks, no compiler.
const ShaderModule& load_module(const ShaderSource& source, Number number, std::optional<Isa> isa = {});

// The same, compiled on demand with line tables, built-in shaders too.
const ShaderModule& load_module_with_lines(const ShaderSource& source, Number number, std::optional<Isa> isa = {});

// The built-in module of a source, null where it is not built in.
const ShaderModule* find_builtin_module(const ShaderSource& source);

// The code that load_module looks for: lanes on the instruction set whose registers hold them, as far as `isa` allows.
struct CodeTarget {
  Isa isa = Isa::baseline;
  Number number = Number::lanes4;
};
// UserError for an instruction set that the machine lacks.
CodeTarget code_target(Number number, std::optional<Isa> isa = {});

struct CompileOptions {
  Isa isa = Isa::baseline;
  std::uint32_t numbers = 1;  // bit n: enum Number's n-th
  int optimisation = 2;       // -O0 to -O3
  std::string compiler;       // as find_compiler takes it
  bool line_tables = false;   // with what tells profilers its lines of GLSL and its callers: frame pointers
};
// Compiles C++ that the translator wrote to a shared object in the cache (or finds it there) and returns its path.
// UserError where there is no compiler, the cache cannot be written, or the compiler refuses (its first error).
std::string compile_shader(const std::string& cpp, const CompileOptions& options);
// For one number type, optimised.
inline std::string compile_shader(const std::string& cpp, Isa isa, Number number, const std::string& compiler = {}) {
  return compile_shader(cpp, CompileOptions{isa, 1u << int(number), 2, compiler});
}

}  // namespace twinshade
