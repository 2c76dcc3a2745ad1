// glTF 2.0: nodes, meshes, skins at rest, materials, cameras.
#pragma once

#include <string>

#include "scenes/model_part.h"

namespace twinshade {

// needs_camera: whether the model is drawn by a camera that the file has. Where it is, a camera that sees nothing is a
// UserError; where not, the model has no camera then.
Model read_gltf_model(const std::string& path, bool needs_camera);

}  // namespace twinshade
