// Models from files, drawn by the program as a user would.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "run_twinshade.h"
#include "tests/scenes/model_writers.h"

namespace twinshade {
namespace {

// A floor, three walls and a ceiling, open towards +Z.
std::string room(const Folder& folder) {
  return folder.file("room.obj",
                     "v -2 0 -3\nv 2 0 -3\nv 2 3 -3\nv -2 3 -3\nv -2 0 3\nv 2 0 3\nv 2 3 3\nv -2 3 3\n"
                     "f 1 2 3 4\nf 5 1 4 8\nf 2 6 7 3\nf 5 6 2 1\nf 4 3 7 8\n");
}

std::string frame(const std::string& model, const std::string& camera, const std::string& technique = "h4") {
  const Run run = run_twinshade({"render", model, "--technique", technique, "--size", "16x16", "--rays", "4",
                                 "--camera", camera, "--quiet", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return run.json()["frame"];
}

}  // namespace

TEST_CASE("a camera in a room, close to a wall, far away or straight above sees the model") {
  const Folder folder;
  const std::string model = room(folder), nothing = frame(model, "0,1.5,100,0,1.5,200,60");
  for (const char* camera :
       {"0,1.5,1,0,1.5,-3,60", "0,1.5,-2.98,0,1.5,-3,60", "0,1.5,2000,0,1.5,0,0.2", "0,2.9,0,0,0,0,40"}) {
    CAPTURE(camera);
    CHECK(frame(model, camera) != nothing);
  }
}

TEST_CASE("--camera draws a model whose own camera has no direction") {
  const Folder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  writer.root["scenes"][0]["nodes"] = {0, 1};
  writer.root["nodes"][1] = {{"camera", 0}, {"scale", {0, 0, 0}}};
  writer.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}}};
  const std::string model = folder.file("flat.glb", writer.glb());
  const Run refused = run_twinshade({"render", model, "-o", folder / "frame.png"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("flat.glb: the camera of node 1") != std::string::npos);
  CHECK(refused.err.find("--camera") != std::string::npos);
  const std::string seen = "0.5,0.5,3,0.5,0.5,0,40";
  CHECK(frame(model, seen) != frame(model, "0.5,0.5,3,0.5,0.5,6,40"));
  CHECK(frame(model, seen, "reference") != frame(model, "0.5,0.5,3,0.5,0.5,6,40", "reference"));
}

TEST_CASE("a model is all in the picture in frames that are higher than wide") {
  const Folder folder;
  const std::string model = folder.file("strip.obj", "v -4 0 0\nv 4 0 0\nv 4 0.5 0\nv -4 0.5 0\nf 1 2 3 4\n");
  for (const auto& [size, width] : {std::pair<const char*, int>{"24x96", 24}, {"48x60", 48}, {"48x48", 48}}) {
    const std::string picture = folder / "strip.png";
    const Run run = run_twinshade({"render", model, "--size", size, "--rays", "4", "--quiet", "-o", picture});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    const auto in = OIIO::ImageInput::open(picture);
    REQUIRE(in);
    const int channels = in->spec().nchannels, height = in->spec().height;
    REQUIRE(in->spec().width == width);
    std::vector<unsigned char> texels(std::size_t(width * height * channels));
    REQUIRE(in->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, texels.data()));
    std::vector<bool> drawn(static_cast<std::size_t>(width));  // of each column; the corners are empty
    for (int i = 0; i < width * height; ++i)
      for (int c = 0; c < channels; ++c)
        if (texels[std::size_t(i * channels + c)] != texels[std::size_t(c)]) drawn[std::size_t(i % width)] = true;
    CHECK_FALSE(drawn.front());
    CHECK_FALSE(drawn.back());
    CHECK(std::count(drawn.begin(), drawn.end(), true) > width / 2);
  }
}

}  // namespace twinshade
