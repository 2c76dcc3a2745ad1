// A shader that tells a value from its middle: in the order of execution, what each statement stored, each condition
// was, each function was handed and returned. Comparing those of two machines finds the first line at which they part.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct ProbedStatement {
  std::string file;  // as in ShaderSource::files
  int line = 0, last_line = 0;
  std::string what;       // "sum", "v.xy, i", "condition", "result of f", "argument 1 of f"
  bool computes = false;  // with floats; else it copies or is about integers alone
  // "int", "uvec2": no statement, but floats within one that are converted to this. Else empty.
  std::string converted_to = {};
};

// A scalar, vector or matrix column that a statement tells of.
struct ProbedValue {
  std::size_t statement = 0;
  std::vector<std::string> name;  // {"sum"}, {"s.second"}, {"P[2]"}; {"w", ".x"} where an element stands between
};

// All that is added has names of this beginning, which no shader has by chance; drawing refuses twinshade_ itself.
// The added input (flat int): which of the values, counted from 0 in the order of execution, goes out.
inline constexpr const char* kProbeTarget = "twinshadeprobe_target";
// The added outputs (uvec4): up to four components by bit pattern; then the ProbedValue + 1 (0: there were fewer
// values), how many values there are in all, Scalar | components << 2 | third element << 16, first element | second <<
// 16 (elements of the arrays that stand between the parts of its name). Discarding is left out, so that every row
// answers; in functions with loops that give no value, it returns.
inline constexpr const char* kProbeValue = "twinshadeprobe_value";
inline constexpr const char* kProbePlace = "twinshadeprobe_place";

struct ProbedShader {
  ShaderSource source;  // every line keeps its file and number
  std::vector<ProbedStatement> statements;
  std::vector<ProbedValue> values;
  bool complete = true;  // false: some store cannot be told of
};

// only: tell of these statements alone, so that the others compile as they would without it; the shader has been
// through with all of them. UserError where the shader is not valid GLSL.
ProbedShader add_probes(const ShaderSource& source, const std::optional<std::set<std::size_t>>& only = {});

}  // namespace twinshade
