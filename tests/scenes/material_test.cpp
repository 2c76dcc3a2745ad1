// What materials of model files may hold.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "base/sanitizers.h"
#include "scenes/scene.h"
#include "tests/scenes/image_writers.h"
#include "tests/scenes/model_writers.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;

namespace {

// The process may take so many bytes more than it has.
struct LessMemory {
  rlimit old{};
  explicit LessMemory(std::size_t more_bytes) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    REQUIRE(getrlimit(RLIMIT_AS, &old) == 0);
    rlimit lower = old;
    lower.rlim_cur = pages * std::size_t(sysconf(_SC_PAGESIZE)) + more_bytes;
    REQUIRE(setrlimit(RLIMIT_AS, &lower) == 0);
  }
  ~LessMemory() { setrlimit(RLIMIT_AS, &old); }
};

// An OBJ triangle whose material has the given lines.
std::string triangle_with(const TemporaryFolder& folder, const std::string& lines) {
  folder.write("m.mtl", "newmtl plain\nKd .5 .5 .5\nnewmtl odd\n" + lines);
  return folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl odd\nf 1/1 2/1 3/1\n");
}

}  // namespace

TEST_CASE("colours that are negative or not finite are refused, naming file and material") {
  TemporaryFolder folder;
  for (const char* colour : {"nan .5 .5", ".5 1e39 .5", ".5 .5 -1"}) {
    const std::string message =
        user_error([&] { load_scene(triangle_with(folder, std::string("Kd ") + colour + "\n")); });
    INFO(colour << ": " << message);
    CHECK(message.find("m.obj: material 'odd': its colour") != std::string::npos);
  }
  CHECK(load_scene(triangle_with(folder, "Kd 0 1 1.5\n")).materials[0].albedo == glm::vec3(0, 1, 1));
  for (const double factor : {1e300, -0.25}) {
    GltfWriter writer;
    nlohmann::json square = writer.square();
    square["material"] = 0;
    writer.mesh(square);
    writer.root["materials"] = {
        {{"name", "odd"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, factor, 0.5, 1}}}}}};
    const std::string message = user_error([&] { load_scene(folder.write("m.glb", writer.glb())); });
    INFO(factor << ": " << message);
    CHECK(message.find("m.glb: material 'odd': its colour") != std::string::npos);
  }
}

TEST_CASE("a floating-point picture with a bad colour is refused, naming it and the pixel") {
  TemporaryFolder folder;
  const std::string model = triangle_with(folder, "Kd 1 1 1\nmap_Kd colour.exr\n");
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
    std::vector<float> texels(4 * 3 * 3, 0.5f);
    write_image(folder.name("colour.exr"), 4, 3, 3, texels);
    CHECK(load_scene(model).images.size() == 1);
    texels[(1 * 4 + 2) * 3 + 1] = odd;
    write_image(folder.name("colour.exr"), 4, 3, 3, texels);
    const std::string message = user_error([&] { load_scene(model); });
    INFO(message);
    CHECK(message.find("m.obj: " + folder.name("colour.exr") + ": the colour at pixel (2, 1)") != std::string::npos);
  }
}

TEST_CASE("what is wrong with a picture names the model and the picture") {
  TemporaryFolder folder;
  folder.write("damaged.png", "\x89PNG, cut");
  for (const char* picture : {"missing.png", "damaged.png"})
    for (const char* use : {"map_Kd ", "norm ", "map_Bump "}) {
      const std::string model = triangle_with(folder, std::string(use) + picture + "\n");
      const std::string message = user_error([&] { load_scene(model); });
      INFO(message);
      CHECK(message.find(model + ": " + folder.name(picture) + ": ") == 0);
    }
}

TEST_CASE("a model whose pictures do not fit into memory is refused by name") {
  if (kShadowMemory) {
    MESSAGE("not tested: sanitizers map more addresses than any limit allows");
    return;
  }
  TemporaryFolder folder;
  write_image(folder.name("large.png"), 4, 4, 1, std::vector<std::uint8_t>(16));
  load_scene(triangle_with(folder, "map_Kd large.png\n"));  // whatever is loaded with the first picture
  write_image(folder.name("large.png"), 4096, 4096, 1, std::vector<std::uint8_t>(4096 * 4096));
  const std::string model = triangle_with(folder, "map_Kd large.png\n");
  const auto refusal_with = [&](std::size_t more_bytes) {
    const LessMemory less(more_bytes);
    return user_error([&] { load_scene(model); });
  };
  CHECK(refusal_with(std::size_t(50) << 20).find("large.png: cannot be read as an image: there is not enough memory") !=
        std::string::npos);
  CHECK(refusal_with(std::size_t(200) << 20).find("m.obj: there is not enough memory") != std::string::npos);
}
