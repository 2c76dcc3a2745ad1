// --uniform: values of a user's shader's own uniforms.
#pragma once

#include <string>
#include <vector>

#include "bundle/bundle.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// given: "NAME=VALUE,..." each, NAME as GLSL says it ("tint", "light.colour", "weights" for a whole array), VALUE
// numbers or true and false, of matrices column by column. UserError for what is no such text, a uniform that the
// shader does not have outside of blocks (with the nearest names), a sampler, another number of values than its type
// has, numbers that the type cannot hold, a uniform that is given twice.
std::vector<Uniform> uniform_values(const ShaderSource& source, const std::vector<std::string>& given);

}  // namespace twinshade
