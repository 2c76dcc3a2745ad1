// GL's type of a uniform against the bundle's.
#pragma once

#include <optional>
#include <string>

#include "bundle/bundle.h"
#include "raster/gl/protocol.h"
#include "raster/gl/worker/program.h"

namespace twinshade::gl {

struct UniformType {
  Scalar scalar;
  std::uint32_t columns, rows;
};

std::optional<UniformType> uniform_type(GLenum type);  // nothing: a sampler, a double or an image
std::string type_text(Scalar scalar, std::uint32_t columns, std::uint32_t rows);

// glUniform* for `count` elements; the type has been checked.
void set_uniform(const GlFunctions& gl, GLint location, const UniformType& type, GLsizei count, const float* values);

}  // namespace twinshade::gl
