#include "scenes/model_camera.h"

#include <doctest/doctest.h>

using namespace twinshade;
using glm::dvec3;

namespace {

const Bounds kRoom{dvec3(-2, 0, -3), dvec3(2, 3, 3)};

}  // namespace

TEST_CASE("a user's camera has planes that all before it lies between: inside, close, outside, far away") {
  const dvec3 corner(2, 3, 3);
  for (const auto& [eye, target] : {std::pair{dvec3(0, 1.5, 0), dvec3(2, 1.5, 0)},
                                    {dvec3(0, 1.5, 0), dvec3(0.001, 1.5, 0)},
                                    {dvec3(1.99, 1, 0), dvec3(2, 1, 0)},
                                    {dvec3(0, 1.5, 8), dvec3(0, 1.5, 0)},
                                    {dvec3(0, 1.5, 500), dvec3(0, 1.5, 0)},
                                    {dvec3(0, 1.5, 1e9), dvec3(0, 1.5, 0)}}) {
    const Camera camera = camera_at(kRoom, eye, target, 40);
    const double distance = eye.z;  // clang++ 14 captures no structured bindings
    CAPTURE(distance);
    CHECK(camera.eye == eye);
    CHECK(camera.target == target);
    CHECK(camera.vertical_fov_degrees == 40);
    CHECK(camera.near_plane > 0);
    CHECK(camera.near_plane < camera.far_plane);
    const dvec3 forward = glm::normalize(target - eye);
    // What is looked at, where there is something, and the farthest corner
    if (glm::length(target - eye) > 0.002) CHECK(glm::dot(target - eye, forward) > camera.near_plane);
    for (int c = 0; c < 8; ++c) {
      const dvec3 at((c & 1 ? 1 : -1) * corner.x, c & 2 ? corner.y : 0, (c & 4 ? 1 : -1) * corner.z);
      CHECK(glm::dot(at - eye, forward) < camera.far_plane);
      if (eye.z > 4) CHECK(glm::dot(at - eye, forward) > camera.near_plane);
    }
  }
}

TEST_CASE("up is +Y, and -Z for a view straight down or up") {
  CHECK(camera_at(kRoom, dvec3(0, 1, 5), dvec3(0), 40).up == dvec3(0, 1, 0));
  CHECK(camera_at(kRoom, dvec3(0, 3, 0), dvec3(0), 40).up == dvec3(0, 0, -1));
  CHECK(camera_at(kRoom, dvec3(1, 0, 2), dvec3(1, 7, 2), 40).up == dvec3(0, 0, -1));
  CHECK(up_or_north(dvec3(0, 1, 0), dvec3(1, 2, 3), dvec3(0)) == dvec3(0, 1, 0));
}
