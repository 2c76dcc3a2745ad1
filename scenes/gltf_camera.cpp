#include "scenes/gltf_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "scenes/gltf_document.h"
#include "scenes/scene_limits.h"

namespace twinshade {

using glm::dmat4;
using glm::dvec3;
using nlohmann::json;

Camera gltf_camera(const json& camera, const dmat4& world) {
  Camera result;
  result.eye = dvec3(world[3]);
  // Far from the origin, a target one metre away would lose the direction to rounding.
  result.target =
      result.eye - dvec3(world[2]) / glm::length(dvec3(world[2])) * std::max(1.0, glm::length(result.eye) * 1e-6);
  result.up = dvec3(world[1]) / glm::length(dvec3(world[1]));
  if (const auto orthographic = camera.find("orthographic"); orthographic != camera.end()) {
    result.orthographic_height = 2 * std::fabs(gltf_number(*orthographic, "ymag", 0));
    result.near_plane = gltf_number(*orthographic, "znear", 0);
    result.far_plane = gltf_number(*orthographic, "zfar", 0);
  } else {
    const json& perspective = camera.at("perspective");
    result.vertical_fov_degrees = gltf_number(perspective, "yfov", 1) * 180 / portable::kPi;
    result.near_plane = gltf_number(perspective, "znear", 0.1);
    result.far_plane = gltf_number(perspective, "zfar", std::numeric_limits<double>::infinity());
  }
  return result;
}

std::string gltf_camera_fault(const json& camera, const dmat4& world) {
  const double across = glm::length(dvec3(world[2])), upright = glm::length(dvec3(world[1]));
  if (!(across > 0 && upright > 0 && std::isfinite(across) && std::isfinite(upright)))
    return "has no direction: its node is scaled to nothing";
  const Camera placed = gltf_camera(camera, world);
  if (!(glm::length(placed.eye) <= kLargestCoordinate)) return "lies farther than 1e15 from the origin";
  if (!(glm::length(glm::cross(placed.up, glm::normalize(placed.eye - placed.target))) > 1e-9))
    return "looks along its up direction: its node is sheared flat";
  if (camera.contains("orthographic")) {
    const bool sees = placed.orthographic_height > 0 && placed.orthographic_height <= kLargestCoordinate &&
                      placed.near_plane >= 0 && placed.far_plane > placed.near_plane &&
                      placed.far_plane <= kLargestCoordinate;
    return sees ? "" : "sees nothing: its height (ymag) or planes are damaged";
  }
  const double fov = placed.vertical_fov_degrees;
  if (!(fov > 0 && fov < 180 && placed.near_plane > 0 && placed.near_plane <= kLargestCoordinate &&
        placed.far_plane > placed.near_plane))
    return "sees nothing: its field of view or planes are damaged";
  return "";
}

}  // namespace twinshade
