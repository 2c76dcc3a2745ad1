// Khronos Group, glTF 2.0 specification, section 3.10: cameras.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes/scene.h"

namespace twinshade {

// An element of "cameras", placed by its node. The width of its view is the frame's, whatever the file says.
Camera gltf_camera(const nlohmann::json& camera, const glm::dmat4& world);

// Why nothing can be drawn by a camera placed so; empty: it can.
std::string gltf_camera_fault(const nlohmann::json& camera, const glm::dmat4& world);

}  // namespace twinshade
