// A bundle is the same however it is reached, and a frame is the same however it is drawn.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {
namespace {

nlohmann::json render(const std::vector<std::string>& options) {
  std::vector<std::string> after{"--technique", "sh3", "--json", "-"};
  after.insert(after.end(), options.begin(), options.end());
  const Run run = run_twinshade(small_quad({"render"}, after));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return run.json();
}

}  // namespace

TEST_CASE("a baked bundle draws what its scene draws") {
  const Folder folder;
  const std::string file = folder / "quad.bundle";
  const Run bake = run_twinshade(small_quad({"bake"}, {"--technique", "sh3", "-o", file, "--json", "-"}));
  REQUIRE_MESSAGE(bake.code == 0, bake.err);
  const Run drawn = run_twinshade({"render", file, "--technique", "sh3", "--json", "-"});
  REQUIRE_MESSAGE(drawn.code == 0, drawn.err);
  const auto direct = render({});
  CHECK(drawn.json()["frame"] == direct["frame"]);
  CHECK(drawn.json()["bundle"] == direct["bundle"]);
  CHECK(bake.json()["bundle"] == direct["bundle"]);
}

TEST_CASE("lanes, tiles and threads draw the same frame") {
  const std::string frame = render({})["frame"];
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{"--lanes", "4"},
                                                                                       {"--lanes", "8"},
                                                                                       {"--lanes", "16"},
                                                                                       {"--number", "scalar"},
                                                                                       {"--isa", "baseline"},
                                                                                       {"--tile", "16"},
                                                                                       {"--tile", "32"},
                                                                                       {"--tile", "128"},
                                                                                       {"--threads", "7"}}) {
    CAPTURE(options[0] + " " + options[1]);
    CHECK(render(options)["frame"] == frame);
  }
}

TEST_CASE("double draws, and differs from float by rounding only") {
  const auto wide = render({"--number", "float64"});
  CHECK(wide["frame"] != render({})["frame"]);
}

TEST_CASE("seed, rays, rotation and switches change the bundle") {
  const std::string bundle = render({})["bundle"];
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--seed", "2"},
                                             {"--env-rotation", "90"},
                                             {"--albedo", "off"},
                                             {"--normal-map", "off"},
                                             {"--env", "studio"},
                                             {"--camera", "1,2,4,0,0,0,40"},
                                             {"--camera", "-1,2,4,0,0,0,40"}}) {
    CAPTURE(options[0] + " " + options[1]);
    CHECK(render(options)["bundle"] != bundle);
  }
}

}  // namespace twinshade
