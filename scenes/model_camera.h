// Cameras for scenes that come from model files, whose size and place nobody knows beforehand.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/scene.h"

namespace twinshade {

// Axis-parallel, in metres.
struct Bounds {
  glm::dvec3 low, high;
};

// Of one position at least.
Bounds bounds_of(const std::vector<glm::vec3>& positions);

// Looks at the middle of the bounds from the front, a little right and above, as near as has all corners in view.
// aspect: width by height of the frame, above 0; one that is wider than high is framed as a square. Bounds of no extent
// have no such camera.
Camera framing_camera(const Bounds& bounds, double aspect);

// The user's eye, target and field of view, with near and far planes between which all that the bounds hold before the
// eye is seen, down to a hundredth of the way to the target (or of the bounds' radius, where that is less). Up is +Y.
Camera camera_at(const Bounds& bounds, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov_degrees);

// Metres from the camera's eye, beyond all that the bounds hold and at least 10000 times the near plane.
double far_plane_behind(const Bounds& bounds, const Camera& camera);

// What is up for a camera that looks from eye to target: `up`, but -Z where the view is along it.
glm::dvec3 up_or_north(const glm::dvec3& up, const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace twinshade
