// The verb frontier: speed and error of techniques, side by side.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {
namespace {

Run frontier(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"frontier",
                                     "house",
                                     "--env",
                                     "window",
                                     "--size",
                                     "96x64",
                                     "--lightmap",
                                     "64",
                                     "--rays",
                                     "64",
                                     "--volume",
                                     "4x4x4",
                                     "--probe-rays",
                                     "64",
                                     "--visibility-rays",
                                     "64",
                                     "--pixels",
                                     "500",
                                     "--reference-rays",
                                     "128",
                                     "--rounds",
                                     "2",
                                     "--repeat",
                                     "1",
                                     "--seed",
                                     "3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_twinshade(arguments);
}

}  // namespace

TEST_CASE("each technique has its cost and its error, and those on the frontier are not beaten in both") {
  const Folder folder;
  const Run run = frontier({"--technique", "lightmap,h4,sh5,zh3,unc3", "--json", "-", "-o", folder / "out"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json json = run.json(), rows = json["rows"];
  REQUIRE(rows.size() == 5);
  CHECK(json["truth"]["pixels"] == 500);
  CHECK(json["truth"]["noise"] > 0);
  CHECK(json["truth"]["noise"] < 0.2);
  int on_frontier = 0;
  for (const auto& row : rows) {
    CAPTURE(row.dump());
    CHECK(row["shade_ns_per_pixel"] > 0);
    CHECK(row["ns_per_pixel"] > row["shade_ns_per_pixel"]);
    CHECK(row["error"] > 0);
    CHECK(row["error"] < 2);
    CHECK(row["arithmetic_error"].is_null());
    CHECK(row["truth"] == (row["technique"] == "unc3" ? "direct" : "bounced"));
    on_frontier += row["on_frontier"] == true;
    for (const auto& other : rows)
      if (row["on_frontier"] == true)
        CHECK_FALSE((other["shade_ns_per_pixel"] < row["shade_ns_per_pixel"] && other["error"] < row["error"]));
  }
  CHECK(on_frontier >= 1);
  CHECK(rows[0]["technique"] == "lightmap");
  CHECK(rows[0]["stored"] == 3);
  CHECK(rows[4]["stored"] == 9);
  for (const char* name :
       {"frontier.csv", "frontier.svg", "frontier.png", "frontier-storage.svg", "frontier-storage.png"})
    CHECK_MESSAGE(std::filesystem::exists(folder / ("out/" + std::string(name))), name);
}

TEST_CASE("errors do not depend on the number of threads") {
  const auto errors = [](const char* threads) {
    const Run run = frontier({"--technique", "h4,sh3", "--threads", threads, "--json", "-"});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    std::string text;
    const auto json = run.json();
    for (const auto& row : json["rows"]) text += row["error"].dump() + " " + row["worst"].dump() + "\n";
    return text;
  };
  CHECK(errors("1") == errors("2"));
}

TEST_CASE("in double a technique is the same but for float's rounding") {
  const Run run = frontier({"--technique", "lightmap", "--arithmetic", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const auto row = run.json()["rows"][0];
  CHECK(row["arithmetic_error"] > 1e-9);
  CHECK(row["arithmetic_error"] < 1e-5);
}

TEST_CASE("a user's shader is measured beside techniques: the same basis written anew has the same error") {
  const Folder folder;
  const std::string shader = folder.file("own.frag", R"(#version 450
in vec2 v_uv;
in vec2 v_lightmap_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;
uniform sampler2DArray coefficients_sh2;
out vec4 color;
void main() {
  vec3 irradiance = 0.282094792 * texture(coefficients_sh2, vec3(v_lightmap_uv, 0)).rgb +
                    0.488602512 * texture(coefficients_sh2, vec3(v_lightmap_uv, 2)).rgb;
  color = vec4(irradiance / 3.14159265 * texture(albedo_maps, vec3(v_uv, v_material)).rgb, 1);
}
)");
  const Run run = frontier({"--technique", "sh2", "--shader", shader, "--normal-map", "off", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json rows = run.json()["rows"];
  REQUIRE(rows.size() == 2);
  CHECK(rows[1]["technique"] == shader);
  CHECK(rows[1]["light"].is_null());
  CHECK(rows[1]["stored"].is_null());
  CHECK(double(rows[1]["error"]) == doctest::Approx(double(rows[0]["error"])).epsilon(1e-3));
}

TEST_CASE("frontier refuses what has no light to compare") {
  const auto refused = [](const std::vector<std::string>& arguments, const char* reason) {
    const Run run = run_twinshade(arguments);
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
  };
  refused({"frontier", "--technique", "reference"}, "reference");
  // Before light that would take hours.
  refused({"frontier", "quad", "--technique", "cutout", "--lightmap", "4096", "--rays", "65536"}, "technique cutout");
  refused({"frontier", "raster_torture", "--volume", "256x256x256", "--probe-rays", "65536"},
          "no surfaces in the world");
  refused({"frontier", "--reference-rays", "1"}, "--reference-rays");
  refused({"frontier", "--pixels", "0"}, "--pixels");
  refused({"frontier", "house", "--technique", "h4", "--camera", "0,500,0,0,900,0,30", "--size", "16x16", "--lightmap",
           "4096", "--rays", "65536"},
          "sees no surface");
  const Folder folder;
  const std::string bundle = folder / "a.bundle";
  std::vector<std::string> bake = small_quad({"bake"}, {"--technique", "h4", "-o", bundle});
  REQUIRE(run_twinshade(bake).code == 0);
  refused({"frontier", bundle, "--technique", "h4"}, "a bundle has not");
  const std::string wrong = folder.file("wrong.frag", "#version 450\nout vec4 c;\nvoid main() { c = vec4(d); }\n");
  refused({"frontier", "--shader", wrong, "--technique", "h4", "--lightmap", "4096", "--rays", "65536"},
          "wrong.frag:3");
}

TEST_CASE("noise above all light is told as a number, not as a power of ten") {
  const Run run =
      run_twinshade({"frontier", "house", "--env", "studio", "--size", "60x40", "--lightmap", "16", "--rays", "4",
                     "--reference-rays", "2", "--technique", "h4", "--rounds", "1", "--repeat", "1"});
  REQUIRE(run.code == 0);
  CHECK_MESSAGE(run.err.find("its own noise 104 %") != std::string::npos, run.err);
}

TEST_CASE("where rays find no light frontier and choose say so, and nothing has an error") {
  const Folder folder;
  // A Radiance picture, 16 x 8, all black.
  const std::string black =
      folder.file("black.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n" + std::string(16 * 8 * 4, '\0'));
  for (const char* verb : {"frontier", "choose"}) {
    const Run run =
        run_twinshade(small_quad({verb}, {"--technique", "h4", "--light", "lightmap", "--env", black, "--pixels", "50",
                                          "--reference-rays", "8", "--rounds", "1", "--repeat", "1", "--json", "-"}));
    CHECK_MESSAGE(run.code == (verb == std::string("choose") ? 1 : 0), run.err);
    CHECK_MESSAGE(run.err.find("by 8 rays, which found none: nothing has an error") != std::string::npos, run.err);
    const nlohmann::json json = run.json();
    CHECK(json["truth"]["noise"].is_null());
    CHECK(json["rows"][0]["error"].is_null());
  }
}

}  // namespace twinshade
