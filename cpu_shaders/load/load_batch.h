// Many shaders at once: several to one compilation unit, units on all threads. For tests of thousands of small shaders,
// which a compiler spends less time on than on the runtime's headers.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cpu_shaders/load/load.h"

namespace twinshade {

struct BatchOptions {
  CompileOptions compile{Isa::baseline, 1, 1, {}};
  std::size_t shaders_per_unit = 24;
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread, one at a time
};

struct BatchModule {
  const ShaderModule* module = nullptr;  // stays valid until the process ends
  std::string error;                     // where there is no module: one line
};

// cpp: Translation::cpp of each shader, not made with TranslateOptions::readable. The result likewise. Modules have the
// entries of options.compile.numbers (float64 only where the shader can run in double). Where a unit does not compile,
// its shaders are compiled one by one, so that only the guilty one has an error; but for a unit that takes too long,
// all have.
std::vector<BatchModule> load_batch(std::span<const std::string> cpp, const BatchOptions& options);

}  // namespace twinshade
