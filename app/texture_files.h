// --texture: pictures for a user's shader's own sampler2D.
#pragma once

#include <string>
#include <vector>

#include "bundle/bundle.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// The file of "NAME=FILE". UserError for a text that is no such thing.
std::string texture_file(const std::string& given);

// given: "NAME=FILE" each. Linear filter, repeated; row 0 of a texture is the picture's lowest, as OpenGL has it.
// Values as the file has them, integers divided by their largest, nothing decoded; grey is in R, G and B, alpha 1 where
// the file has none. UserError for a sampler2D that the shader does not have (with the nearest names), a picture that
// cannot be read or has NaN or infinite values (naming the pixel), a sampler that is given twice.
std::vector<Texture> texture_files(const ShaderSource& source, const std::vector<std::string>& given);

}  // namespace twinshade
