// glTF 2.0: nodes, meshes, skins at rest, materials, cameras.
#pragma once

#include <string>

#include "scenes/model_part.h"

namespace twinshade {

Model read_gltf_model(const std::string& path);

}  // namespace twinshade
