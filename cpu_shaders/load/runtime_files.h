// The runtime's files in the cache: what compiled shaders include and link.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "cpu_shaders/load/compiler.h"
#include "cpu_shaders/load/run_program.h"

namespace twinshade {

// SHA-256 over the runtime that this binary carries.
const std::string& embedded_runtime_hash();

// Unpacks the runtime into the cache, unless it is there; the folder to include it from.
std::string unpack_runtime();

// What is the same for all shaders that are compiled with the same flags, made once.
struct PreparedRuntime {
  std::string header;         // -include it: clang++ finds the precompiled form beside it
  std::string portable_math;  // object file
};
// runtime: of unpack_runtime. flags: without -shared and without definitions that differ between shaders. UserError
// where the runtime cannot be compiled.
PreparedRuntime prepare_runtime(const std::string& runtime, const Compiler& compiler,
                                const std::vector<std::string>& flags);

// Removes what prepare_runtime made: a compiler that refuses its own precompiled header (a file under it changed) gets
// a new one.
void discard_prepared(const PreparedRuntime& prepared);

// UserError, one line, unless the command succeeded and there is a file `made`: the command's first complaint, or that
// it had none. what: was to be compiled.
void require_made(const std::string& made, const Compiler& compiler, const ProgramResult& result,
                  const std::string& what);

}  // namespace twinshade
