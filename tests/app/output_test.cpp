// Where output goes, and what the verbs that only show say.
#include <doctest/doctest.h>
#include <fstream>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("help and version succeed on stdout") {
  for (const char* option : {"--help", "--version"}) {
    const Run run = run_twinshade({option});
    CHECK(run.code == 0);
    CHECK_FALSE(run.out.empty());
    CHECK(run.err.empty());
  }
  for (const char* verb : {"list", "bake", "render", "compare", "translate", "bench", "experiment"}) {
    CAPTURE(verb);
    const Run run = run_twinshade({verb, "--help"});
    CHECK(run.code == 0);
    for (const char* option : {"--json", "--threads", "--seed", "--quiet"})
      CHECK(run.out.find(option) != std::string::npos);
  }
}

TEST_CASE("list names what there is") {
  const Run run = run_twinshade({"list", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const auto json = run.json();
  const auto names = [&](const char* kind) {
    std::string text = " ";
    for (const auto& entry : json[kind]) text += entry["name"].get<std::string>() + " ";
    return text;
  };
  for (const char* name : {" lightmap ", " hl2 ", " h4 ", " h6 ", " sh3 ", " cutout "})
    CHECK(names("techniques").find(name) != std::string::npos);
  CHECK(names("bases").find(" cutout ") == std::string::npos);
  for (const char* name : {" courtyard ", " spheres ", " quad ", " raster_torture "})
    CHECK(names("scenes").find(name) != std::string::npos);
  for (const char* name : {" sky ", " studio ", " window ", " constant "})
    CHECK(names("environments").find(name) != std::string::npos);
  CHECK(names("backends") == " cpu egl osmesa softpipe gpu ");
  for (const auto& scene : json["scenes"])
    if (scene["name"] == "courtyard") CHECK(scene["triangles"].get<int>() >= 20000);
}

TEST_CASE("JSON goes to a file whole, and the table to stdout") {
  const Folder folder;
  const Run run = run_twinshade({"list", "techniques", "--json", folder / "list.json"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.out.find("directional_occlusion") != std::string::npos);
  std::ifstream in(folder / "list.json");
  CHECK(nlohmann::json::parse(in)["techniques"].size() > 0);
  CHECK(folder.names() == std::vector<std::string>{"list.json"});
}

TEST_CASE("render writes every kind of picture, and nothing else") {
  const Folder folder;
  for (const char* name : {"a.exr", "a.hdr", "a.png"}) {
    const Run run =
        run_twinshade(small_quad({"render"}, {"-o", folder / name, "--exposure", "-1", "--tonemap", "aces"}));
    INFO(run.err);
    CHECK(run.code == 0);
  }
  CHECK(folder.names() == std::vector<std::string>{"a.exr", "a.hdr", "a.png"});
}

TEST_CASE("translate writes C++ that names its GLSL") {
  const Folder folder;
  const Run run = run_twinshade({"translate", "h4", "-o", folder / "h4.cpp"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  std::ifstream in(folder / "h4.cpp");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  CHECK(text.find("cpu_shaders/runtime/runtime.h") != std::string::npos);
  CHECK(text.find("shaders/basis/h4.glsl") != std::string::npos);
  CHECK(run_twinshade({"translate", "h4"}).out == text);
}

}  // namespace twinshade
