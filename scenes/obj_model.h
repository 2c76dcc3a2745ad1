// Wavefront OBJ with its MTL materials, through assimp.
#pragma once

#include <string>

#include "scenes/model_part.h"

namespace twinshade {

Model read_obj_model(const std::string& path);

}  // namespace twinshade
