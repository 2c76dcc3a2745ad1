#include <doctest/doctest.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/scene.h"
#include "tests/scenes/model_writers.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using glm::dvec3;
using nlohmann::json;

TEST_CASE("a camera in the file is used; a skinned mesh follows its joints, not its node") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  primitive["attributes"]["JOINTS_0"] = writer.accessor(std::vector<std::uint8_t>(16, 0), "VEC4", 5121, 4);
  std::vector<float> weights;
  for (int i = 0; i < 4; ++i) weights.insert(weights.end(), {1, 0, 0, 0});
  primitive["attributes"]["WEIGHTS_0"] = writer.floats(weights, "VEC4", 4);
  writer.mesh(primitive);
  writer.root["skins"] = json::array({{{"joints", {1}}}});
  writer.root["nodes"] = json::array({{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                                      {{"translation", {0, 5, 0}}},
                                      {{"camera", 0}, {"translation", {0, 5, 9}}}});
  writer.root["scenes"][0]["nodes"] = {0, 1, 2};
  writer.root["cameras"] =
      json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}, {"zfar", 75}}}}});
  const Scene scene = load_scene(folder.write("m.glb", writer.glb()));
  for (const glm::vec3& p : scene.positions) {
    CHECK(p.x <= 1);
    CHECK(p.y >= 5);
  }
  CHECK(scene.camera.eye == dvec3(0, 5, 9));
  CHECK(glm::length(scene.camera.target - dvec3(0, 5, 8)) < 1e-12);
  CHECK(scene.camera.vertical_fov_degrees == doctest::Approx(0.5 * 180 / 3.14159265358979));
  CHECK(scene.camera.near_plane == 0.25);
  CHECK(scene.camera.far_plane == 75);
}

TEST_CASE("a joint that mirrors turns triangles round as a node does: flat normals point as the file's would") {
  TemporaryFolder folder;
  for (const bool normals : {true, false}) {
    GltfWriter writer;
    json primitive = writer.square(normals);
    primitive["attributes"]["JOINTS_0"] = writer.accessor(std::vector<std::uint8_t>(16, 0), "VEC4", 5121, 4);
    primitive["attributes"]["WEIGHTS_0"] = writer.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    writer.mesh(primitive);
    writer.root["skins"] = json::array({{{"joints", {1}}}});
    writer.root["nodes"] = json::array({{{"mesh", 0}, {"skin", 0}}, {{"scale", {-1, 1, 1}}}});
    writer.root["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load_scene(folder.write("m.glb", writer.glb()));
    CAPTURE(normals);
    REQUIRE(scene.triangle_count() == 2);
    for (const glm::vec3& n : scene.normals) CHECK(n == glm::vec3(0, 0, 1));
  }
}
