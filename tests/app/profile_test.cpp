// `profile`, run as a user would.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("profile names the line that the time goes to, in the shader or in what it includes, and changes no bit") {
  const Folder folder;
  folder.file("part.glsl",
              "float costly(float x) {\n  float sum = 0.0;\n"
              "  for (int i = 0; i < 40; ++i)\n    sum += sin(x + float(i));\n  return sum;\n}\n");
  const std::string shader = folder.file("s.frag",
                                         "#include \"part.glsl\"\nin vec2 v_uv;\nout vec4 color;\n"
                                         "void main() {\n  float cheap = v_uv.x * 3.0 + v_uv.y;\n"
                                         "  color = vec4(costly(cheap), cheap, 0.5, 1.0);\n}\n");
  const Run run = run_twinshade({"profile", "quad", "--shader", shader, "--size", "640x400", "--lightmap", "16",
                                 "--rays", "16", "--seconds", "1", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json json = run.json();
  CHECK(json["samples_in_shader"] > 10);
  REQUIRE(json["lines"].size() > 0);
  CAPTURE(json["lines"].dump());
  CHECK(json["lines"][0]["line"] == 4);
  CHECK(json["lines"][0]["file"].get<std::string>().ends_with("part.glsl"));
  CHECK(json["lines"][0]["text"] == "for (int i = 0; i < 40; ++i) sum += sin(x + float(i));");
  CHECK(json["lines"][0]["share"] > 0.6);
  CHECK(json["shade_ms"] < json["frame_ms"]);
  CHECK(json["frame"] == run_twinshade({"render", "quad", "--shader", shader, "--size", "640x400", "--lightmap", "16",
                                        "--rays", "16", "--json", "-"})
                             .json()["frame"]);
  CHECK(run.err.find("part.glsl:4") != std::string::npos);
}

TEST_CASE("profile looks into built-in techniques, one at a time, and refuses the rest in one line") {
  const Run run = run_twinshade(small_quad({"profile"}, {"--technique", "h4", "--seconds", "0.1"}));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.out.find("h4 (lightmap): shading takes") != std::string::npos);
  const auto refused = [](const std::vector<std::string>& arguments, const char* reason) {
    const Run wrong = run_twinshade(arguments);
    CHECK(wrong.code == 2);
    CHECK_MESSAGE(wrong.err.find(reason) != std::string::npos, wrong.err);
  };
  refused({"profile", "--technique", "h4,sh3"}, "profile looks into one");
  refused({"profile", "--technique", "all"}, "profile looks into one");
  refused({"profile", "--light", "all"}, "--light all: profile looks into one");
  refused({"profile", "--seconds", "0"}, "--seconds 0: must be a number above 0");
  refused({"profile", "--shader", "none.frag"}, "none.frag");
}

}  // namespace twinshade
