// Models from files: glTF 2.0 and OBJ.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace twinshade {

// ".gltf", ".glb" or ".obj" in lower case; empty for any other ending.
std::string model_file_ending(const std::string& path);

// The file's triangles in world space with node transforms applied; UserError in one line for what cannot be read or
// drawn, and for models beyond the limits of scenes/scene_limits.h. needs_camera: as for load_scene.
Scene load_model_file(const std::string& path, bool needs_camera);

}  // namespace twinshade
