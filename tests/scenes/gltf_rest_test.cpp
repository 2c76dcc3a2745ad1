// What stands between a glTF file's meshes and where they are drawn: morph targets, joints, instances, cameras; and
// what is said of that which is not drawn.
#include <doctest/doctest.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/model_camera.h"
#include "scenes/scene.h"
#include "tests/scenes/model_writers.h"
#include "tests/scenes/notes.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using nlohmann::json;
using test::has_note;

TEST_CASE("morph targets are added by their weights at rest, the node's before the mesh's") {
  TemporaryFolder folder;
  for (const bool of_node : {false, true}) {
    GltfWriter writer;
    json primitive = writer.square();
    const int up = writer.floats({0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0}, "VEC3", 3);
    const int out = writer.floats({0, 0, 8, 0, 0, 8, 0, 0, 8, 0, 0, 8}, "VEC3", 3);
    const int turn = writer.floats({4, 0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0}, "VEC3", 3);
    primitive["targets"] = json::array({{{"POSITION", up}}, {{"POSITION", out}, {"NORMAL", turn}}});
    writer.mesh(primitive);
    writer.root["meshes"][0]["weights"] = {0.5, 0};
    if (of_node) writer.root["nodes"][0]["weights"] = {0, 0.25};
    const Scene scene = load_scene(folder.write("m.glb", writer.glb()));
    const Bounds bounds = bounds_of(scene.positions);
    CAPTURE(of_node);
    CHECK(bounds.low == (of_node ? glm::dvec3(0, 0, 2) : glm::dvec3(0, 1, 0)));
    CHECK(bounds.high == (of_node ? glm::dvec3(1, 1, 2) : glm::dvec3(1, 2, 0)));
    const glm::vec3 normal = glm::normalize(of_node ? glm::vec3(1, 0, 1) : glm::vec3(0, 0, 1));
    for (const glm::vec3& n : scene.normals) CHECK(glm::length(n - normal) < 1e-6f);
    CHECK(!has_note(scene, "morph"));
  }
}

TEST_CASE("a vertex that follows eight joints follows them all") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  std::vector<float> half;
  for (int i = 0; i < 4; ++i) half.insert(half.end(), {0.5, 0, 0, 0});
  for (const int set : {0, 1}) {
    const std::vector<std::uint8_t> joint(16, std::uint8_t(set));
    primitive["attributes"]["JOINTS_" + std::to_string(set)] = writer.accessor(joint, "VEC4", 5121, 4);
    primitive["attributes"]["WEIGHTS_" + std::to_string(set)] = writer.floats(half, "VEC4", 4);
  }
  writer.mesh(primitive);
  writer.root["skins"] = json::array({{{"joints", {1, 2}}}});
  writer.root["nodes"] =
      json::array({{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 6, 0}}}, {{"translation", {0, 0, 2}}}});
  writer.root["scenes"][0]["nodes"] = {0, 1, 2};
  const Bounds bounds = bounds_of(load_scene(folder.write("m.glb", writer.glb())).positions);
  CHECK(bounds.low == glm::dvec3(0, 3, 1));
  CHECK(bounds.high == glm::dvec3(1, 4, 1));
}

TEST_CASE("instances of a mesh are drawn where they stand within their node") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  const int moves = writer.floats({0, 0, 0, 5, 0, 0, 0, 0, -3}, "VEC3", 3);
  const int scales = writer.floats({1, 1, 1, -2, 2, 2, 1, 1, 1}, "VEC3", 3);
  const json attributes = {{"TRANSLATION", moves}, {"SCALE", scales}};
  writer.root["extensionsUsed"] = writer.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  writer.root["nodes"][0]["translation"] = {0, 10, 0};
  writer.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  const Scene scene = load_scene(folder.write("m.glb", writer.glb()));
  CHECK(scene.triangle_count() == 6);
  const Bounds bounds = bounds_of(scene.positions);
  CHECK(bounds.low == glm::dvec3(0, 10, -3));
  CHECK(bounds.high == glm::dvec3(5, 12, 0));
  for (std::size_t t = 0; t < 6; ++t) {  // the mirrored one, too, shows its front where its normals point
    const auto corner = [&](std::size_t k) { return scene.positions[scene.indices[3 * t + k]]; };
    CHECK(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z > 0);
    CHECK(scene.normals[scene.indices[3 * t]] == glm::vec3(0, 0, 1));
  }
  CHECK(!has_note(scene, "extensions"));

  writer.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = moves;
  CHECK(user_error([&] { load_scene(folder.write("m.glb", writer.glb())); }).find("node 0's instances") !=
        std::string::npos);
  const int many = int(writer.root["accessors"].size());
  writer.root["accessors"].push_back({{"componentType", 5126}, {"count", 1 << 20}, {"type", "VEC3"}});
  const json claimed = {{"TRANSLATION", many}};
  writer.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = claimed;
  json primitive = writer.square(false, false);
  std::vector<std::uint16_t> corners(300, 1);
  primitive["indices"] = writer.indices(corners);
  writer.mesh(primitive);
  writer.root["nodes"][0]["mesh"] = 1;
  CHECK(user_error([&] { load_scene(folder.write("m.glb", writer.glb())); }).find("node 0 has 1048576 instances") !=
        std::string::npos);
}

TEST_CASE("an orthographic camera is used, the first of several is, and what it cannot see with is named") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  writer.root["scenes"][0]["nodes"] = {0, 1, 2};
  writer.root["nodes"].push_back({{"camera", 0}, {"translation", {0, 5, 9}}, {"scale", {2, 2, 2}}});
  writer.root["nodes"].push_back({{"camera", 1}});
  json lens = {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 75}};
  const json other = {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}};
  writer.root["cameras"] = json::array({{{"type", "orthographic"}, {"orthographic", lens}}, other});
  const Scene scene = load_scene(folder.write("m.glb", writer.glb()));
  CHECK(scene.camera.orthographic_height == 6);
  CHECK(scene.camera.near_plane == 0);
  CHECK(scene.camera.far_plane == 75);
  CHECK(scene.camera.eye == glm::dvec3(0, 5, 9));
  CHECK(!scene.camera_frames);
  CHECK(has_note(scene, "the first of its cameras"));
  for (const char* key : {"ymag", "zfar"}) {
    writer.root["cameras"][0]["orthographic"] = lens;
    writer.root["cameras"][0]["orthographic"][key] = 0;
    const std::string message = user_error([&] { load_scene(folder.write("m.glb", writer.glb())); });
    INFO(message);
    CHECK(message.find("the camera of node 1 sees nothing") != std::string::npos);
  }
}

TEST_CASE("what of a glTF file is not drawn is said by name") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  primitive["material"] = 0;
  writer.mesh(primitive);
  writer.root["materials"] = json::array({{{"occlusionTexture", {{"index", 0}}}}});
  writer.root["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform", "KHR_materials_unlit", "X\n"};
  writer.root["animations"] = json::array({json::object()});
  writer.root["scenes"].push_back(json::object());
  const Scene scene = load_scene(folder.write("m.glb", writer.glb()));
  CHECK(has_note(scene, "what these extensions say is ignored: KHR_lights_punctual, KHR_materials_unlit, X?"));
  CHECK(has_note(scene, "animations are ignored"));
  CHECK(has_note(scene, "of its 2 scenes, scene 0 is drawn"));
  CHECK(has_note(scene, "occlusion maps are ignored"));

  GltfWriter plain;
  plain.mesh(plain.square());
  plain.root["extensionsUsed"] = {"KHR_mesh_quantization", "KHR_materials_variants"};
  for (const std::string& note : load_scene(folder.write("plain.glb", plain.glb())).notes)
    CHECK(note.find("ignored") == std::string::npos);
}
