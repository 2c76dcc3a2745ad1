// Which textures a shader reads at coordinates that are inputs of it: whoever runs the shader can ask for their texels
// before it does. A hint, which no result depends on: what is not found, or found wrongly, costs time alone.
#pragma once

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {

struct TextureCoordinates {
  Id coordinates = 0;  // input variable, a vec2
  Id layer = 0;        // input variable, an int; 0: layer 0, or all layers at once
};

// By sampler variable, of sampler2D and sampler2DArray. The first place that reads it counts.
std::map<Id, TextureCoordinates> texture_coordinates(const Program& program);

}  // namespace twinshade::spirv
