#include "lighting/camera.h"

#include <cmath>

#include "base/error.h"
#include "base/portable_math.h"

namespace twinshade {

CameraTransform::CameraTransform(const Camera& camera, double aspect)
    : eye_(camera.eye), orthographic_(camera.orthographic_height > 0) {
  const double fov = camera.vertical_fov_degrees, near = camera.near_plane, far = camera.far_plane;
  if (!orthographic_ && !(fov > 0 && fov < 180))
    throw UserError("camera: a vertical field of view of " + std::to_string(fov) + " degrees is not within 0 to 180");
  if (!((orthographic_ ? near >= 0 : near > 0) && far > near && std::isfinite(far)))
    throw UserError("camera: near plane " + std::to_string(near) + " and far plane " + std::to_string(far) +
                    " are not 0 < near < far");
  const glm::dvec3 backward = camera.eye - camera.target;
  const double distance = std::sqrt(glm::dot(backward, backward));
  if (!(distance > 0 && std::isfinite(distance)))
    throw UserError("camera: the eye is at the target: give another target");
  backward_ = backward / distance;
  const glm::dvec3 right = glm::cross(camera.up, backward_);
  const double length = std::sqrt(glm::dot(right, right));
  if (!(length > 1e-9 * std::sqrt(glm::dot(camera.up, camera.up))))
    throw UserError("camera: it looks along its up direction: give another up or target");
  right_ = right / length;
  up_ = glm::cross(backward_, right_);
  scale_y_ = orthographic_ ? 2 / camera.orthographic_height : 1 / portable::tan(fov * portable::kPi / 360);
  scale_x_ = scale_y_ / aspect;
  depth_scale_ = (orthographic_ ? 2 : far + near) / (near - far);
  depth_offset_ = (orthographic_ ? far + near : 2 * far * near) / (near - far);
}

glm::dvec4 CameraTransform::clip(const glm::dvec3& world) const {
  const glm::dvec3 d = world - eye_;
  const double z = glm::dot(backward_, d);
  return {scale_x_ * glm::dot(right_, d), scale_y_ * glm::dot(up_, d), depth_scale_ * z + depth_offset_,
          orthographic_ ? 1 : -z};
}

}  // namespace twinshade
