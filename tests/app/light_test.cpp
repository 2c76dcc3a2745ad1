// --light: lightmaps, vertices and volumes from the command line.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "run_twinshade.h"

namespace twinshade {
namespace {

std::vector<std::string> lit_quad(std::vector<std::string> before, std::vector<std::string> after) {
  after.insert(after.begin(), {"--volume", "3x2x3", "--probe-rays", "32"});
  return small_quad(std::move(before), after);
}

nlohmann::json compared(const std::vector<std::string>& options) {
  std::string backends = "cpu";
  for (const std::string& backend : opengl_backends()) backends += "," + backend;
  if (backends == "cpu") return nlohmann::json();
  std::vector<std::string> after{"--on", backends, "--json", "-"};
  after.insert(after.end(), options.begin(), options.end());
  const Run run = run_twinshade(lit_quad({"compare"}, after));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return run.json();
}

}  // namespace

TEST_CASE("each technique is drawn once from everything it can be read from, the same on all machines") {
  const auto json = compared({"--technique", "sh3,h4", "--light", "all"});
  if (json.is_null()) return;
  std::set<std::string> lights;
  for (const auto& row : json["results"]) {
    CHECK(row["pixels_differ"] == 0);
    CHECK(row["shaded_pixels"] > 0);
    lights.insert(row["technique"].get<std::string>() + " " + row["light"].get<std::string>());
  }
  CHECK(lights == std::set<std::string>{"h4 lightmap", "h4 vertex", "sh3 lightmap", "sh3 vertex", "sh3 volume"});
  CHECK(json["provenance"]["bundle_notes"]["coefficients"] == "lightmap vertex volume");
}

TEST_CASE("all techniques from a volume: those that cannot are skipped, with the reason") {
  const auto json = compared({"--technique", "all", "--light", "volume"});
  if (json.is_null()) return;
  for (const auto& row : json["results"]) {
    CAPTURE(row.dump());
    CHECK(row["light"] == "volume");
    CHECK(row["pixels_differ"] == 0);
  }
  std::set<std::string> skipped;
  for (const auto& row : json["skipped"]) skipped.insert(row["technique"].get<std::string>());
  CHECK(skipped.contains("h4"));
  CHECK(skipped.contains("unc3"));
  CHECK(skipped.contains("reference"));
}

TEST_CASE("a bundle with several storages draws what its scene draws") {
  const Folder folder;
  const std::string file = folder / "quad.bundle";
  const Run bake = run_twinshade(lit_quad({"bake"}, {"--technique", "sh3,h4", "--light", "all", "-o", file}));
  REQUIRE_MESSAGE(bake.code == 0, bake.err);
  std::set<std::string> frames;
  for (const std::string light : {"lightmap", "vertex", "volume"}) {
    const Run drawn = run_twinshade({"render", file, "--technique", "sh3", "--light", light, "--json", "-"});
    const Run direct = run_twinshade(lit_quad({"render"}, {"--technique", "sh3", "--light", light, "--json", "-"}));
    REQUIRE_MESSAGE(drawn.code == 0, drawn.err);
    REQUIRE_MESSAGE(direct.code == 0, direct.err);
    CHECK(drawn.json()["frame"] == direct.json()["frame"]);
    CHECK(drawn.json()["light"] == light);
    frames.insert(drawn.json()["frame"].get<std::string>());
  }
  CHECK(frames.size() == 3);
  const Run automatic = run_twinshade({"render", file, "--technique", "sh3", "--json", "-"});
  CHECK(automatic.json()["light"] == "lightmap");
  const Run missing = run_twinshade({"render", file, "--technique", "h6"});
  CHECK(missing.code == 2);
  CHECK(missing.err.find("bake it again") != std::string::npos);
}

TEST_CASE("only what is drawn is baked") {
  const Run run = run_twinshade(lit_quad({"render"}, {"--technique", "sh3", "--light", "volume", "--json", "-"}));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const auto notes = run.json()["provenance"]["bundle_notes"];
  CHECK(notes["coefficients"] == "volume");
  CHECK(notes["volume"] == "3x2x3");
  CHECK_FALSE(notes.contains("bake_hash"));
}

TEST_CASE("a user's shader that names a volume gets it") {
  const Folder folder;
  const std::string shader =
      folder.file("mine.frag",
                  "uniform sampler2DArray volume_sh2;\nuniform ivec3 volume_size;\n"
                  "out vec4 color;\n"
                  "void main() { color = texelFetch(volume_sh2, ivec3(0, volume_size.y - 1, 0), 0); }\n");
  const Run run = run_twinshade(lit_quad({"render"}, {"--shader", shader, "--json", "-"}));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.json()["provenance"]["bundle_notes"]["coefficients"] == "volume");
}

TEST_CASE("coefficients that a user's shader names in a comment alone are not baked") {
  const Folder folder;
  const std::string code = "in vec2 v_uv; out vec4 color;\nvoid main() { color = vec4(v_uv, 0.0, 1.0); }\n";
  const auto bundle_of = [&](const std::string& text) {
    const Run run = run_twinshade(lit_quad({"render"}, {"--shader", folder.file("my.frag", text), "--json", "-"}));
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run.json()["bundle"];
  };
  CHECK(bundle_of("// not coefficients_h4\n/* nor\nvolume_sh3 */\n" + code) == bundle_of(code));
}

TEST_CASE("light that there is not is refused by name") {
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--technique", "h4", "--light", "volume"},
                                             {"--technique", "sh3", "--light", "lightmaps"},
                                             {"--technique", "sh3", "--light", "all"},
                                             {"--technique", "sh3", "--volume", "4x4"},
                                             {"--technique", "sh3", "--volume", "4x4x0"},
                                             {"--technique", "sh3", "--volume", "4x4x999"},
                                             {"--technique", "sh3", "--light", "volume", "--volume", "1x256x256"}}) {
    const Run run = run_twinshade(small_quad({"render"}, wrong));
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
  const Run spheres = run_twinshade({"render", "raster_torture", "--technique", "sh3", "--light", "lightmap"});
  CHECK(spheres.code == 2);
  CHECK(spheres.err.find("--light vertex") != std::string::npos);
}

}  // namespace twinshade
