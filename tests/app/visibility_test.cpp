// Techniques of precomputed visibility, from the command line.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {
namespace {

std::string all_machines() {
  std::string machines = "cpu";
  for (const std::string& backend : opengl_backends()) machines += "," + backend;
  return machines;
}

std::vector<std::string> seen_quad(std::vector<std::string> before, std::vector<std::string> after) {
  after.insert(after.end(), {"--visibility-rays", "64", "--map-width", "5", "--json", "-"});
  return small_quad(std::move(before), after);
}

std::string frame_of(const std::vector<std::string>& options) {
  const Run run = run_twinshade(seen_quad({"render"}, options));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return run.json()["frame"];
}

// A lat-long RGBE picture of 2 x 1 black pixels.
std::string black_environment(const Folder& folder) {
  return folder.file("black.hdr",
                     std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") + std::string(8, '\0'));
}

}  // namespace

TEST_CASE("packed textures draw the bits that layered ones draw, on every machine") {
  const std::string machines = all_machines();
  std::vector<std::string> technique{"--technique", "unc3,pca8,preconv,sh2_product", "--visibility-packing", "dx9"};
  if (machines != "cpu") {
    technique.insert(technique.end(), {"--on", machines});
    const Run run = run_twinshade(seen_quad({"compare"}, technique));
    REQUIRE_MESSAGE(run.code == 0, run.err);
    CHECK(run.json()["provenance"]["bundle_notes"]["visibility_packing"] == "dx9");
    const nlohmann::json results = run.json()["results"];
    for (const auto& row : results) {
      CAPTURE(row.dump());
      CHECK(row["pixels_differ"] == 0);
      CHECK(row["shaded_pixels"] > 0);
    }
  }
  for (const std::string name : {"unc3", "pca8", "preconv", "sh2_product"})
    CHECK(frame_of({"--technique", name}) == frame_of({"--technique", name, "--visibility-packing", "dx9"}));
}

TEST_CASE("a bundle file remembers how its textures are packed") {
  const Folder folder;
  const std::string file = folder / "packed.bundle";
  const Run bake =
      run_twinshade(seen_quad({"bake"}, {"--technique", "unc3", "--visibility-packing", "dx9", "-o", file}));
  REQUIRE_MESSAGE(bake.code == 0, bake.err);
  const Run drawn = run_twinshade({"render", file, "--technique", "unc3", "--json", "-"});
  REQUIRE_MESSAGE(drawn.code == 0, drawn.err);
  CHECK(drawn.json()["frame"] == frame_of({"--technique", "unc3"}));
}

TEST_CASE("no light is a black frame, not an error") {
  const Folder folder;
  const std::string black = black_environment(folder), picture = folder / "black.png";
  for (const std::string name : {"unc3", "preconv", "sh2_product"}) {
    const Run run = run_twinshade(seen_quad({"render"}, {"--technique", name, "--env", black, "-o", picture}));
    CHECK_MESSAGE(run.code == 0, run.err);
  }
  CHECK(frame_of({"--technique", "unc3", "--env", black}) == frame_of({"--technique", "preconv", "--env", black}));
}

TEST_CASE("one triangle without texture coordinates is drawn from its vertices, and that is said") {
  const Folder folder;
  const std::string model = folder.file("triangle.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Run run = run_twinshade(
      {"render", model, "--technique", "sh2_product", "--size", "64x40", "--visibility-rays", "64", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.json()["light"] == "vertex");
  CHECK(run.err.find("per vertex") != std::string::npos);
}

TEST_CASE("technique reference has no shader: it is listed, but not to be compared") {
  const Run named = run_twinshade(small_quad({"compare"}, {"--technique", "h4,reference"}));
  CHECK(named.code == 2);
  CHECK(named.err.find("reference") != std::string::npos);
  const auto listed = run_twinshade({"list", "techniques", "--json", "-"}).json()["techniques"];
  CHECK(listed.back()["name"] == "reference");
}

}  // namespace twinshade
