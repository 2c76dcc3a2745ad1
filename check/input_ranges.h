// What a shader is fed: the range of each input and uniform, as its author declares them in comments,
//   // @input uv 0..1
//   // @input v_normal unit
// or in a side file (the same without `// @input`), and what is assumed where nothing is said (docs/check.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct InputRange {
  enum class Kind {
    interval,  // low .. high
    list,      // one of some values
    unit,      // vectors of length 1
    finite,    // every finite float, by its bits
    any,       // every float: infinities and NaN too
  };
  std::string name;   // of an input, a uniform (by GLSL path) or a sampler
  std::string where;  // "file:line: ", for messages
  Kind kind = Kind::interval;
  // One for each component, or one for all.
  std::vector<std::pair<double, double>> intervals;
  std::vector<double> values;  // list
};

// From the comments of a shader and of what it includes that no #if leaves out. UserError "file:line: ..." for what
// cannot be read, and for a second line for the same name.
std::vector<InputRange> declared_ranges(const ShaderSource& source);
// From a side file; the same.
std::vector<InputRange> ranges_in_file(const std::string& path);
// Both, a side file's behind: `side_file`, or where that is empty SHADER.inputs beside the shader's file, if there is
// one.
std::vector<InputRange> all_ranges(const ShaderSource& source, const std::string& path, std::string side_file);

// The range of a name, the last one that was declared; where there is none, floats -10..10, ints 0..15.
const InputRange* find_range(const std::vector<InputRange>& ranges, const std::string& name);

}  // namespace twinshade
