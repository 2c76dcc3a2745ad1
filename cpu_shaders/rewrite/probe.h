// A shader that tells a value from its middle: in the order of execution, what each statement stored, each condition
// was and each function returned. Comparing those of two machines finds the first line at which they part.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct ProbedStatement {
  std::string file;  // as in ShaderSource::files
  int line = 0, last_line = 0;
  std::string what;  // "sum", "v.xy, i", "condition", "result of f"
};

// The added input (flat int): which of the values, counted from 0 in the order of execution, goes out.
inline constexpr const char* kProbeTarget = "probe_target";
// The added outputs (uvec4): up to four components by bit pattern; then statement + 1 (0: there were fewer values), how
// many values there are in all, 1 for floats, components. Discarding is left out, so that every row answers.
inline constexpr const char* kProbeValue = "probe_value";
inline constexpr const char* kProbePlace = "probe_place";

struct ProbedShader {
  ShaderSource source;  // every line keeps its file and number
  std::vector<ProbedStatement> statements;
};

// only: tell of this statement alone, so that the others compile as they would without it. UserError where the shader
// is not valid GLSL.
ProbedShader add_probes(const ShaderSource& source, std::optional<std::size_t> only = {});

}  // namespace twinshade
