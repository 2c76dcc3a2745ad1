// Reports speak of the author's inputs alone. The two machines are the CPU flushing denormals and the CPU keeping them,
// unless something else is said.
#include <doctest/doctest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>

#include "check/check_shader.h"

namespace twinshade {
namespace {

CheckedShader checked(const std::string& text, CheckOptions options) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("twinshade_check_shader_" + std::to_string(::getpid()) + ".frag");
  std::ofstream(path) << text;
  options.on.resize(2);
  options.timing = false;
  Evaluator evaluator;
  CheckedShader result = check_shaders(evaluator, {path.string()}, options).at(0);
  std::filesystem::remove(path);
  return result;
}

CheckedShader checked_exact(const std::string& text) {
  CheckOptions options;
  options.on.resize(2);
  options.on[1].keep_denormals = true;
  options.generate.rows = 16;
  options.make_exact = true;
  return checked(text, options);
}

const std::string kShader =
    "// @input x 7.8e-31..7.9e-31\n// @input y 9e-13..9.1e-13\n// @input z 1e30..1.1e30\n"
    "in float x; in float y; in float z; out vec4 c;\n"
    "void main() {\n  c = vec4(x * y * z + 0.0) * gl_FragCoord.w;\n}\n";

}  // namespace

TEST_CASE("the smallest input has gl_FragCoord by its name, and nothing that --make-exact added") {
  const CheckedShader shader = checked_exact(kShader);
  CAPTURE(shader.message);
  REQUIRE(shader.counterexample.has_value());
  std::string names;
  for (const Values& values : shader.counterexample->values.inputs) names += values.name + " ";
  CHECK(names == "x y z gl_FragCoord ");
  CHECK(shader.counterexample->values.uniforms.empty());
  REQUIRE(shader.counterexample->first_line.difference.has_value());
  CHECK(shader.counterexample->first_line.difference->statement.line == 6);
}

TEST_CASE("an input keeps its range where its name gives way to one that --make-exact added") {
  const CheckedShader shader = checked_exact(
      "// @input exact_add 0..1\nin float exact_add; out float c;\nvoid main() { c = exact_add * 0.5 + 0.25; }\n");
  CAPTURE(shader.message);
  CHECK(shader.verdict == Verdict::same_bits);
}

TEST_CASE("the report has the author's names for what gave way to others") {
  const CheckedShader shader = checked_exact(
      "#version 330\n// @input patch 7.8e-31..7.9e-31\n// @input exact_add 9e-13..9.1e-13\n// @input z 1e30..1.1e30\n"
      "in float patch; uniform float exact_add; in float z; out vec4 buffer;\n"
      "void main() {\n  vec4 sample = vec4(patch * exact_add * z + 0.0);\n  buffer = sample;\n}\n");
  CAPTURE(shader.message);
  REQUIRE(shader.counterexample.has_value());
  CHECK(shader.counterexample->values.inputs.at(0).name == "patch");
  CHECK(shader.counterexample->values.uniforms.at(0).name == "exact_add");
  CHECK(shader.counterexample->difference.output == "buffer.x");
  REQUIRE(shader.counterexample->first_line.difference.has_value());
  CHECK(shader.counterexample->first_line.difference->statement.what.find("_name") == std::string::npos);
}

TEST_CASE("a row that differs only among others is not shown as an input that differs") {
  // llvmpipe leaves the loop early where a `continue` leaves the inner switch in some of the rows that run together.
  CheckOptions options;
  options.on.resize(2);
  options.on[1].backend = Backend::egl;
  options.generate.rows = 64;
  const CheckedShader shader = checked(
      "flat in int k; out float o;\nvoid main() {\n  float t = 0.0;\n  int i = 0;\n  for (; i < 40; ++i) {\n"
      "    switch (i & 3) {\n      case 0:\n        switch (k & 3) {\n          case 1: t += 1.0; continue;\n"
      "          default: t += 3.0;\n        }\n        t += 4.0;\n        break;\n      default: t += 0.5;\n    }\n"
      "    if (i > k) break;\n  }\n  o = t + float(i);\n}\n",
      options);
  if (shader.verdict != Verdict::differs) {
    MESSAGE("not tested: " << shader.message);  // no EGL, or a Mesa that does not go wrong
    return;
  }
  CHECK(!shader.counterexample.has_value());
  CHECK(shader.message.find("o: cpu ") == 0);
  CHECK(shader.message.find("; the difference is not there when that row is run alone") != std::string::npos);
}

TEST_CASE("an unknown input is answered with the author's own") {
  const CheckedShader shader = checked_exact("// @input nonsense 0..1\n" + kShader);
  CHECK(shader.verdict == Verdict::refused);
  CHECK(shader.message.find("nonsense") != std::string::npos);
  CHECK(shader.message.find("exact_zero") == std::string::npos);
}

}  // namespace twinshade
