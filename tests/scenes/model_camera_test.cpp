#include "scenes/model_camera.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/scenes/model_writers.h"
#include "tests/scenes/temporary_folder.h"

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

TEST_CASE("the camera that frames a model has all its corners in view, near the edges, in frames of any shape") {
  for (const Bounds& bounds : {kRoom, Bounds{dvec3(-9, 0, -1), dvec3(9, 1, 1)}, Bounds{dvec3(5, -8, 5), dvec3(6, 8, 6)},
                               Bounds{dvec3(0), dvec3(1, 0, 0)}})
    for (const double aspect : {1.0 / 300, 0.1, 1.0 / 3, 0.6, 0.999, 1.0, 1.6, 10.0}) {
      const Camera camera = framing_camera(bounds, aspect);
      const dvec3 forward = glm::normalize(camera.target - camera.eye);
      const dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
      const double slope = std::tan(0.5 * camera.vertical_fov_degrees * 3.14159265358979 / 180);
      double widest = 0;  // of the corners, from the middle of the frame, a square's if wider: 1 at its edges
      for (int c = 0; c < 8; ++c) {
        const dvec3 to = dvec3(c & 1 ? bounds.high.x : bounds.low.x, c & 2 ? bounds.high.y : bounds.low.y,
                               c & 4 ? bounds.high.z : bounds.low.z) -
                         camera.eye;
        const double along = glm::dot(to, forward);
        CHECK(along > camera.near_plane);
        CHECK(along < camera.far_plane);
        widest = std::max({widest, std::fabs(glm::dot(to, right)) / (slope * along * std::min(aspect, 1.0)),
                           std::fabs(glm::dot(to, up)) / (slope * along)});
      }
      CAPTURE(aspect);
      CHECK(widest < 1);
      CHECK(widest > 0.9);
      if (aspect >= 1) CHECK(camera.eye == framing_camera(bounds, 1).eye);
    }
}

TEST_CASE("a camera without a far plane sees all that is before it, however near its near plane is") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  writer.root["nodes"] =
      nlohmann::json::array({{{"mesh", 0}, {"scale", {30, 30, 30}}}, {{"camera", 0}, {"translation", {0, 5, 20}}}});
  writer.root["scenes"][0]["nodes"] = {0, 1};
  for (const double near : {1e-6, 0.001, 0.25, 50.0}) {
    writer.root["cameras"] =
        nlohmann::json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", near}}}}});
    const Scene scene = load_scene(folder.write("camera.glb", writer.glb()));
    CAPTURE(near);
    CHECK(scene.camera.near_plane == near);
    CHECK(scene.camera.far_plane >= 10000 * near);
    CHECK(scene.camera.far_plane > glm::length(dvec3(30, 30, 0) - scene.camera.eye));
    CHECK(scene.camera.far_plane < std::max(100.0, 10001 * near));
  }
}
