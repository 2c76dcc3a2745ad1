// What is refused because no shader needs it and a compiler, a stack or a cache would suffer from it. docs/hardening.md
// has the table.
#pragma once

#include "cpu_shaders/translate/function_info.h"

namespace twinshade {

inline constexpr std::size_t kMostText = 4 << 20;  // bytes with all includes
// Of brackets and of statements: clang reads 256 levels of brackets, and the text has a few of its own.
inline constexpr int kMostNesting = 200;
// Numbers in all variables together, tables of constants apart: 2 MiB of stack with sixteen lanes.
inline constexpr std::uint64_t kMostNumbers = 32768;
// Instructions of functions that are written again for arguments that vary otherwise than in the first call.
inline constexpr std::size_t kMostCopied = 1 << 20;
// Iterations and calls that a loop may make in all without counting them while it runs.
inline constexpr std::uint64_t kMostUncounted = 1 << 16;
// Calls and iterations that a program may be known to make.
inline constexpr std::uint64_t kMostWork = std::uint64_t{1} << 26;

// UserError, at the author's file and line where there is one.
void refuse_large_text(const ShaderSource& source);
void refuse_large_variables(const spirv::Program& program, const SourceLines& lines);

}  // namespace twinshade
