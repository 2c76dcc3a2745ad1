// --uniform, as a user would give it.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("--uniform gives a shader its own uniforms, of any type, the same on all machines, in a golden image, too") {
  const Folder folder;
  const std::string declared = "struct Light { vec3 colour; float power; };\nuniform Light light;\n",
                    rest =
                        "in vec2 v_uv;\nout vec4 color;\nvoid main() {\n  precise vec2 t = turn * v_uv;\n"
                        "  color = vec4(light.colour * light.power, float(steps.x + steps.y));\n  color.xy += t;\n"
                        "  if (on) color.z = weights[int(v_uv.x) % 3];\n}\n";
  const std::string given = folder.file("given.frag", declared +
                                                          "uniform mat2 turn;\nuniform float weights[3];\n"
                                                          "uniform ivec2 steps;\nuniform bool on;\n" +
                                                          rest);
  const std::string written =
      folder.file("written.frag", declared +
                                      "const mat2 turn = mat2(0.5, 0.25, -0.25, 0.5);\n"
                                      "const float weights[3] = float[3](0.5, 1.0, 2.0);\n"
                                      "const ivec2 steps = ivec2(3, -1);\nconst bool on = true;\n" +
                                      rest);
  const std::vector<std::string> light{"--uniform", "light.colour=1,0.5,0.25", "--uniform", "light.power=2"};
  std::vector<std::string> all{
      "--uniform", "turn=0.5,0.25,-0.25,0.5", "--uniform", "weights=0.5,1,2", "--uniform", "steps=3,-1", "--uniform",
      "on=true"};
  all.insert(all.end(), light.begin(), light.end());
  const auto with = [](std::vector<std::string> before, const std::vector<std::string>& after) {
    before.insert(before.end(), after.begin(), after.end());
    return before;
  };
  const auto frame = [&](const std::string& shader, const std::vector<std::string>& uniforms) {
    const Run run = run_twinshade(small_quad({"render"}, with({"--shader", shader, "--json", "-"}, uniforms)));
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run.json()["frame"];
  };
  CHECK(frame(given, all) == frame(written, light));
  const std::vector<std::string> opengl = opengl_backends();
  if (!opengl.empty())
    CHECK(run_twinshade(small_quad({"compare"}, with({"--shader", given, "--on", "cpu," + opengl[0]}, all))).code == 0);
  const std::string goldens = folder / "goldens";
  REQUIRE(
      run_twinshade(small_quad({"golden", "update", goldens}, with({"--shader", given, "--name", "g"}, all))).code ==
      0);
  CHECK(run_twinshade({"golden", "check", goldens}).code == 0);

  const auto refused = [&](const std::vector<std::string>& uniforms, const std::string& reason) {
    const Run run = run_twinshade(small_quad({"render"}, with({"--shader", given}, uniforms)));
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
  };
  refused({"--uniform", "tint=1"}, "unknown uniform 'tint'; known: ");
  refused({"--uniform", "light=1"}, "did you mean 'light.");
  refused({"--uniform", "steps=1.5,2"}, "--uniform steps=1.5,2: '1.5' is no value of a ivec2");
  refused({"--uniform", "turn=1"}, "--uniform turn=1: mat2 has 4 values, not 1");
  refused({"--uniform", "on=maybe"}, "--uniform on=maybe: 'maybe' is no value of a bool");
  refused({"--uniform", "light.power=1e60"}, "--uniform light.power=1e60: '1e60' is no value of a float");
  refused({"--uniform", "on"}, "--uniform on: must be NAME=VALUE");
  refused(with({"--uniform", "on=false"}, all), "on is given twice");
  CHECK(run_twinshade({"render", "quad", "--technique", "h4", "--uniform", "a=1"})
            .err.find("--uniform requires --shader") != std::string::npos);
}

}  // namespace twinshade
