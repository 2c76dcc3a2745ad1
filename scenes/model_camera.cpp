#include "scenes/model_camera.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace twinshade {

using glm::dvec3;

Bounds bounds_of(const std::vector<glm::vec3>& positions) {
  Bounds bounds{dvec3(positions[0]), dvec3(positions[0])};
  for (const glm::vec3& p : positions) bounds = {glm::min(bounds.low, dvec3(p)), glm::max(bounds.high, dvec3(p))};
  return bounds;
}

Camera framing_camera(const Bounds& bounds, double aspect) {
  const auto& [low, high] = bounds;
  const dvec3 middle = 0.5 * (low + high);
  const double radius = glm::length(high - middle);
  Camera camera;
  camera.vertical_fov_degrees = 40;
  const double slope = portable::tan(0.5 * camera.vertical_fov_degrees * portable::kPi / 180);
  const dvec3 back = glm::normalize(dvec3(0.55, 0.40, 1.0)), right = glm::normalize(glm::cross(camera.up, back));
  const dvec3 up = glm::cross(back, right);
  double distance = 0.1 * radius;
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 at =
        dvec3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z) - middle;
    const double aside = std::max(std::fabs(glm::dot(at, right)) / std::min(aspect, 1.0), std::fabs(glm::dot(at, up)));
    distance = std::max(distance, 1.05 * aside / slope + glm::dot(at, back));
  }
  camera.target = middle;
  camera.eye = middle + back * distance;
  camera.near_plane = std::max(0.01 * radius, distance - 1.1 * radius);
  camera.far_plane = distance + 1.1 * radius;
  return camera;
}

Camera camera_at(const Bounds& bounds, const dvec3& eye, const dvec3& target, double vertical_fov_degrees) {
  const dvec3 middle = 0.5 * (bounds.low + bounds.high);
  const double radius = glm::length(bounds.high - middle), distance = glm::length(eye - middle);
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.vertical_fov_degrees = vertical_fov_degrees;
  camera.up = up_or_north(camera.up, eye, target);
  camera.far_plane = distance + 1.1 * radius;
  // What is looked at from close by must be seen; that many times nearer than the far plane, depths still differ.
  const double close = std::clamp(0.01 * glm::length(target - eye), 1e-4 * radius, 0.01 * radius);
  // From very far away the planes must not become one number.
  camera.near_plane = std::min(std::max(close, distance - 1.1 * radius), 0.999 * camera.far_plane);
  return camera;
}

double far_plane_behind(const Bounds& bounds, const Camera& camera) {
  const dvec3 middle = 0.5 * (bounds.low + bounds.high);
  return std::max(10000 * camera.near_plane,
                  glm::length(camera.eye - middle) + 1.1 * glm::length(bounds.high - middle));
}

dvec3 up_or_north(const dvec3& up, const dvec3& eye, const dvec3& target) {
  const double aside = glm::length(glm::cross(up, glm::normalize(eye - target)));
  return aside > 1e-9 * glm::length(up) ? up : dvec3(0, 0, -1);
}

}  // namespace twinshade
