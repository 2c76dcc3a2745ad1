// The verb stability: table, JSON, CSV, charts, exit codes.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("stability gives its findings as table, JSON, CSV and charts") {
  const Folder folder;
  const Run run = run_twinshade({"stability", "sh2", "zh3", "--test", "ringing,rounding,storage", "-o", folder / "out",
                                 "--json", folder / "out.json"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.out.find("-0.25  of the peak     poor     sun (0.000, 0.000, 1.000); normal (0.000, 0.000, -1.000)") !=
        std::string::npos);
  std::ifstream file(folder / "out.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  CHECK(json["fails"] == false);
  REQUIRE(json["rows"].size() == 10);
  const auto& row = json["rows"][0];
  CHECK(row["method"] == "sh2");
  CHECK(row["measure"] == "least");
  CHECK(double(row["value"]) == doctest::Approx(-0.25).epsilon(1e-5));
  CHECK(row["light"] == "0x0p+0 0x0p+0 0x1p+0");
  CHECK(row["other_normal"].is_null());
  std::istringstream coefficients(row["coefficients"].get<std::string>());
  std::string word;
  int count = 0;
  while (coefficients >> word) ++count;
  CHECK(count == 12);
  CHECK(folder.names().size() == 2);
  for (const char* name : {"stability.csv", "stability-ringing.svg", "stability-ringing.png",
                           "stability-smoothness.png", "stability-storage.png"})
    CHECK_MESSAGE(std::filesystem::exists(folder / ("out/" + std::string(name))), name);
  CHECK_FALSE(std::filesystem::exists(folder / "out/stability-constant.png"));
}

TEST_CASE("without a technique, a line for each") {
  const Run run = run_twinshade({"stability", "--test", "conditioning"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.out.find("condition") != std::string::npos);
  CHECK(run.out.find("ad_flat") != std::string::npos);
  CHECK(run.out.find("363") != std::string::npos);
  CHECK(run.err.find("--long") != std::string::npos);
  const Run inputs = run_twinshade({"stability", "--test", "conditioning", "--long", "--quiet"});
  CHECK(inputs.out.find("largest by smallest") != std::string::npos);
  CHECK(inputs.err.empty());
}

TEST_CASE("a basis of one's own that divides by zero and has a seam fails, and both inputs are shown") {
  // The Ambient Cube as one might write it: a direction in the plane that is 0/0 at the poles, and sides told apart too
  // late
  constexpr const char* kBroken = R"(const int BASIS_COUNT = 6;
vec3 basis_irradiance(vec3 n) {
  vec2 flat_part = n.xy / sqrt(n.x * n.x + n.y * n.y) * sqrt(1.0 - n.z * n.z);
  return (n.x < 0.3 ? COEF(3) : COEF(0)) * flat_part.x * flat_part.x +
         (n.y < 0.0 ? COEF(4) : COEF(1)) * flat_part.y * flat_part.y + (n.z < 0.0 ? COEF(5) : COEF(2)) * n.z * n.z;
}
)";
  const Folder folder;
  std::filesystem::create_directory(folder / "basis");
  folder.file("basis/ambient_cube.glsl", kBroken);
  const Run run = run_twinshade({"stability", "-I", folder / "", "--test", "finite,jump", "--json", "-"});
  CHECK_MESSAGE(run.code == 1, run.err);
  const nlohmann::json json = run.json(), rows = json["rows"];
  CHECK(json["fails"] == true);
  REQUIRE(rows.size() == 5);
  CHECK(rows[0]["method"] == "ambient_cube");
  CHECK(rows[0]["verdict"] == "fails");
  CHECK(rows[0]["normal"].get<std::string>().find("0x0p+0") != std::string::npos);
  CHECK(rows[3]["measure"] == "value");
  CHECK(rows[3]["verdict"] == "poor");
  CHECK(rows[3]["value"] > 0.01);
  CHECK(rows[3]["normal"].get<std::string>().find("0x1.33333") == 0);  // 0.3

  CHECK(run_twinshade({"stability", "h4", "-I", folder / ""}).err.find("has no basis/h4.glsl") != std::string::npos);
  CHECK(run_twinshade({"stability", "cube", "-I", folder / ""}).code == 2);
  const auto refused = [&](const std::string& glsl, const char* reason) {
    folder.file("basis/ambient_cube.glsl", "const int BASIS_COUNT = 6;\n" + glsl);
    const Run wrong = run_twinshade({"stability", "-I", folder / ""});
    CHECK(wrong.code == 2);
    CHECK_MESSAGE(wrong.err.find(reason) != std::string::npos, wrong.err);
  };
  refused("", "basis_irradiance");
  refused("uniform float u;\nvec3 basis_irradiance(vec3 n) { return COEF(0) * u; }\n",
          "reads uniforms, buffers or textures");
  refused("in float u;\nvec3 basis_irradiance(vec3 n) { return COEF(0) * u; }\n", "reads the input u");
}

TEST_CASE("stability refuses what it cannot test") {
  const auto refused = [](const std::vector<std::string>& arguments, const char* reason) {
    const Run run = run_twinshade(arguments);
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
  };
  refused({"stability", "sh33"}, "sh3");
  refused({"stability", "unc3"}, "is no basis");
  refused({"stability", "sh3", "--test", "ringin"}, "ringing");
  refused({"stability", "sh3", "-o", "/proc/none"}, "/proc/none");
  refused({"stability", "-I", "/proc/none"}, "/proc/none");
  refused({"stability", "-I", "/proc/self"}, "has no file of a basis");
}

}  // namespace twinshade
