// glTF files that are wrong in ways that cost more than a refusal: floods of words, of memory, cameras of no direction.
#include <doctest/doctest.h>

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
  CHECK(message.find("zeros.glb: damaged: accessor 2 has 268435456 elements, but no bufferView") != std::string::npos);
}
