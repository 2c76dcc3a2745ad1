// A scene's materials as two texture arrays, one layer a material.
#pragma once

#include <string>
#include <vector>

#include "bundle/bundle.h"
#include "scenes/scene.h"

namespace twinshade {

// "albedo_maps": linear albedo; 1 x 1 white layers where not `on`, 1 x 1 albedo where no material has an image.
Texture albedo_maps(const Scene& scene, bool on);
// "normal_maps": tangent-space unit normals; 1 x 1 (0, 0, 1) layers where not `on` or where no material has one.
Texture normal_maps(const Scene& scene, bool on);

// A line for each of the two that is on and has pictures of another size than the array's.
std::vector<std::string> resampling_notes(const Scene& scene, bool albedo, bool normal_map);

}  // namespace twinshade
