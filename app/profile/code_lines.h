// Which line of GLSL an instruction of a compiled shader belongs to.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

struct GlslLine {
  std::string file;  // one of those asked for
  int line = 0;
  auto operator<=>(const GlslLine&) const = default;
};

// Whether an address is within the shared object that holds `entry`.
bool is_within(std::uintptr_t address, ShadeFunction entry);

// For each of some addresses within that object the innermost line of one of `files` that was inlined to it; none for
// what has no such line. The object was compiled with CompileOptions::line_tables. UserError where there is no
// addr2line, which comes with compilers (binutils).
std::map<std::uintptr_t, GlslLine> glsl_lines(const std::vector<std::uintptr_t>& addresses, ShadeFunction entry,
                                              const std::vector<std::string>& files);

}  // namespace twinshade
