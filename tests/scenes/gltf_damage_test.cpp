// glTF files that are wrong in ways that cost more than a refusal: floods of words, of memory, cameras of no direction.
#include <doctest/doctest.h>

#include <tuple>

#include "scenes/scene.h"
#include "tests/scenes/model_writers.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using nlohmann::json;

TEST_CASE("a .gltf cut within a data URI is refused with the place, without the data") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  const std::string text = writer.gltf("data:application/octet-stream;base64," + std::string(100000, 'A'));
  const std::string message =
      user_error([&] { load_scene(folder.write("cut.gltf", text.substr(0, text.size() - 50000))); });
  CHECK(message.find("cut.gltf: truncated or damaged JSON") != std::string::npos);
  CHECK(message.find("line 1, column") != std::string::npos);
  CHECK(message.find("AAAA") == std::string::npos);
  CHECK(message.size() < 400);
  writer.root["extensionsRequired"] = {std::string(100000, 'x')};
  CHECK(user_error([&] { load_scene(folder.write("long.glb", writer.glb())); }).size() < 500);
}

TEST_CASE("a small file that claims millions of vertices without data is refused at once") {
  TemporaryFolder folder;
  GltfWriter writer;
  json square = writer.square(false, false);
  writer.root["accessors"].push_back({{"componentType", 5126}, {"count", 268435456}, {"type", "VEC3"}});
  square["attributes"]["POSITION"] = writer.root["accessors"].size() - 1;
  square.erase("indices");
  writer.mesh(square);
  const std::string message = user_error([&] { load_scene(folder.write("zeros.glb", writer.glb())); });
  INFO(message);
  CHECK(message.find("zeros.glb: not supported: accessor 2 has 268435456 elements without a bufferView, of which "
                     "1048576 may be") != std::string::npos);
}

TEST_CASE("what is missing or of another type is named by its place in the file") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  const json whole = json::parse(writer.gltf("m.bin"));
  folder.write("m.bin", writer.binary);
  const auto refused = [&](auto change) {
    json root = whole;
    change(root);
    return user_error([&] { load_scene(folder.write("m.gltf", root.dump())); });
  };
  for (const std::pair<std::string, std::string>& pair : {
           std::pair<std::string, std::string>(refused([](json& r) { r["buffers"][0].erase("byteLength"); }),
                                               "m.gltf: damaged: /buffers/0: key 'byteLength' not found"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["buffers"][0]["byteLength"] = "long"; }),
               "m.gltf: damaged: /buffers/0/byteLength: type must be number, but is string"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["accessors"][1]["type"] = 3; }),
               "m.gltf: damaged: /accessors/1/type: type must be string, but is number"),
           std::pair<std::string, std::string>(refused([](json& r) { r["nodes"][0]["mesh"] = json::array(); }),
                                               "m.gltf: damaged: /nodes/0/mesh: type must be number, but is array"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["accessors"][0]["bufferView"] = -1; }),
               "m.gltf: damaged: /accessors/0/bufferView: must be an integer from 0 on, but is -1"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 4.5; }),
               "m.gltf: damaged: /meshes/0/primitives/0/mode: must be an integer from 0 on, but is 4.5"),
           std::pair<std::string, std::string>(refused([](json& r) { r["scene"] = 1099511627776; }),
                                               "m.gltf: damaged: /scene: there is no 1099511627776"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["asset"]["minVersion"] = "2.9"; }),
               "m.gltf: needs glTF 2.9 (asset.minVersion), which is not supported; export the model as 2.0"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["nodes"][0]["children"] = {0}, r.erase("scenes"), r.erase("scene"); }),
               "m.gltf: damaged: every node is a child of another, so their tree has no root"),
           std::pair<std::string, std::string>(refused([](json& r) { r["buffers"][0]["uri"] = ""; }),
                                               "m.gltf: damaged: the URI of buffer 0 is empty"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["buffers"][0]["uri"] = std::string(5000, 'A'); }),
               "m.gltf: damaged: the URI of buffer 0 has 5000 bytes"),
           std::pair<std::string, std::string>(
               refused([](json& r) { r["bufferViews"][0]["byteStride"] = 4; }),
               "m.gltf: damaged: accessor 0 has elements of 12 bytes, but bufferView 0 a byteStride of 4"),
       }) {
    CHECK(pair.first.substr(pair.first.find("m.gltf")) == pair.second);
  }
  CHECK(user_error([&] {
          load_scene(folder.write("m.gltf", "{\"asset\": "));
        }).find("m.gltf: truncated or damaged JSON: parse error at line 1, column 11: ") != std::string::npos);
}

TEST_CASE("brackets that stand too deep in each other are refused, not followed") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  writer.root["materials"] = {{{"extensions", "HERE"}}};
  const auto with = [&](int depth) {
    std::string text = writer.gltf("m.bin");
    text.replace(text.find("\"HERE\""), 6,
                 "{\"X\":" + std::string(std::size_t(depth), '[') + std::string(std::size_t(depth), ']') + "}");
    return user_error([&] { load_scene(folder.write("deep.gltf", text)); });
  };
  folder.write("m.bin", writer.binary);
  CHECK(with(150) == "");
  CHECK(with(300000).find("deep.gltf: damaged: brackets stand 200 deep") != std::string::npos);
}

TEST_CASE("a URI with a control character in it is refused") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  for (const char* uri : {"a%00.bin", "a%0Ab.bin", "a\tb.bin", "%7f.bin"}) {
    const std::string message = user_error([&] { load_scene(folder.write("m.gltf", writer.gltf(uri))); });
    INFO(message);
    CHECK(message.find("m.gltf: damaged: the URI of buffer 0 has a control character") != std::string::npos);
  }
}

TEST_CASE("a camera far from the origin keeps its direction, one scaled to nothing is refused by name") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  writer.root["scenes"][0]["nodes"] = {0, 1};
  writer.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}}};
  const auto with = [&](const json& change) {
    json node = {{"camera", 0}, {"rotation", {0, 0.6, 0, 0.8}}};
    node.update(change);
    writer.root["nodes"][1] = node;
    return folder.write("camera.glb", writer.glb());
  };
  for (const double far_out : {0.0, 1e7, 1e14}) {
    const Camera camera = load_scene(with({{"translation", {far_out, far_out / 3, 1}}})).camera;
    const glm::dvec3 direction = glm::normalize(camera.target - camera.eye);
    CAPTURE(far_out);
    CHECK(glm::length(direction - glm::dvec3(-0.96, 0, -0.28)) < 1e-8);
  }
  CHECK(user_error([&] {
          load_scene(with({{"scale", {0, 0, 0}}}));
        }).find("camera.glb: the camera of node 1") != std::string::npos);
  CHECK(user_error([&] {
          load_scene(with({{"translation", {1e200, 0, 0}}}));
        }).find("camera.glb: the camera of node 1 lies farther") != std::string::npos);
}

TEST_CASE("a model whose camera sees nothing loads where another camera is given, and is refused where none is") {
  TemporaryFolder folder;
  const auto with = [&](const json& node, const json& perspective) {
    GltfWriter writer;
    writer.mesh(writer.square());
    writer.root["scenes"][0]["nodes"] = {0, 1};
    writer.root["nodes"][1] = node;
    writer.root["cameras"] = {{{"type", "perspective"}, {"perspective", perspective}}};
    return folder.write("camera.glb", writer.glb());
  };
  const json lens = {{"yfov", 0.5}, {"znear", 0.25}};
  const json flat = {1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1};  // up is backward
  const std::string other = "; repair it, or give another with --camera";
  for (const auto& [node, perspective, fault] :
       {std::tuple<json, json, std::string>{{{"camera", 0}, {"scale", {0, 0, 0}}}, lens, "has no direction"},
        {{{"camera", 0}, {"scale", {1, 1, 0}}}, lens, "has no direction"},
        {{{"camera", 0}, {"translation", {1e200, 0, 0}}}, lens, "lies farther than 1e15"},
        {{{"camera", 0}, {"matrix", flat}}, lens, "looks along its up direction"},
        {{{"camera", 0}}, {{"yfov", 0}, {"znear", 0.25}}, "sees nothing"},
        {{{"camera", 0}}, {{"yfov", 0.5}, {"znear", 2}, {"zfar", 1}}, "sees nothing"}}) {
    const std::string file = with(node, perspective);
    const std::string message = user_error([&] { load_scene(file); });
    INFO(message);
    CHECK(message.find("camera.glb: the camera of node 1 " + fault) != std::string::npos);
    CHECK(message.ends_with(other));
    const Scene scene = load_scene(file, 0, false);
    CHECK(scene.triangle_count() == 2);
    CHECK(glm::length(scene.camera.eye - scene.camera.target) > 1);  // frames the square
  }
}
