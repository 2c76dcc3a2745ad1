// From world space to clip space, OpenGL conventions (z from -w to w), in double.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "scenes/scene.h"

namespace twinshade {

class CameraTransform {
 public:
  // UserError where the camera looks nowhere: eye at the target, up along the view, field of view or planes out of
  // range.
  CameraTransform(const Camera& camera, double aspect);

  glm::dvec4 clip(const glm::dvec3& world) const;

 private:
  glm::dvec3 eye_, right_, up_, backward_;
  double scale_x_, scale_y_, depth_scale_, depth_offset_;
  bool orthographic_;
};

}  // namespace twinshade
