// Tables of values to run a shader over: reproducible from a seed, special values among them.
#pragma once

#include <cstdint>

#include "check/input_ranges.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/values.h"

namespace twinshade {

struct GenerateOptions {
  std::size_t rows = 2048;
  std::uint64_t seed = 1;
  std::size_t uniform_sets = 8;  // values of uniforms, each kept for as many rows
};

// Names members of blocks as reflection does, "Block.member", where a range says "instance.member".
void use_block_names(const Reflection& reflection, std::vector<InputRange>& ranges);

// Uniforms keep their values for an eighth of the rows, or as options say. In the first quarter of the rows one input
// at a time is special, in the second every component is with a chance of one half, the rest is random (docs/check.md
// lists what is special). Samplers get 16 x 16 random texels, storage buffers nothing. UserError "file:line: ..." for a
// range of a name that the shader does not have, of more components than it has, or with values that its type cannot
// hold.
ValueTable generate_rows(const Reflection& reflection, const std::vector<InputRange>& ranges,
                         const GenerateOptions& options);

}  // namespace twinshade
