// docs/adding-a-basis.md tells the truth: its example is a basis, as its text stands.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "base/error.h"
#include "cpu_shaders/lint/lint.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"

namespace twinshade {
namespace {

// The first block of that language.
std::string block(const std::string& page, const std::string& language) {
  const std::string fence = "```" + language + "\n";
  const std::size_t from = page.find(fence);
  REQUIRE(from != page.npos);
  return page.substr(from + fence.size(), page.find("```\n", from + fence.size()) - from - fence.size());
}

struct Example {
  std::filesystem::path folder;  // holds basis/sky_ground.glsl
  TechniqueInfo info;
  std::string line;  // that info's texts are in

  Example() {
    std::ifstream in(TWINSHADE_SOURCE_DIR "/docs/adding-a-basis.md");
    const std::string page((std::istreambuf_iterator<char>(in)), {});
    line = block(page, "cpp");
    std::smatch fields;
    const std::regex format(R"rx(BASIS\((\w+), (\w+\.glsl), sphere, (\d+), true, least_squares, all, "([^"]+)"\)\n)rx");
    REQUIRE(std::regex_match(line, fields, format));
    const auto field = [&](int i) {
      return std::string_view(line).substr(std::size_t(fields.position(i)), std::size_t(fields.length(i)));
    };
    info = {field(1), field(2), true, Domain::sphere, std::stoi(fields[3]), true, Projection::least_squares, field(4)};

    std::string name = (std::filesystem::temp_directory_path() / "twinshade_basis_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    folder = name;
    std::filesystem::create_directory(folder / "basis");
    std::ofstream(folder / "basis" / std::string(info.file)) << block(page, "glsl");
  }
  ~Example() { std::filesystem::remove_all(folder); }
  Example(const Example&) = delete;
  Example& operator=(const Example&) = delete;

  std::vector<std::string> folders() const { return {folder.string()}; }
};

}  // namespace

TEST_CASE("the example of adding a basis is drawn from an irradiance volume, and is in the exact dialect") {
  const Example example;
  const ShaderSource source = technique_source(example.info, CoefficientStorage::volume, example.folders());
  for (const LintFinding& finding : lint(source)) FAIL_CHECK(describe(finding));
  CHECK(translate(source).cpp.find("basis_irradiance") != std::string::npos);
}

TEST_CASE(
    "the example of adding a basis holds what its page says: sums of its terms, a constant, the height of the normal") {
  const Example example;
  const ShaderModule& values = load_module(basis_values_source(example.info, example.folders()), Number::float64);
  const ShaderModule& whole = load_module(basis_irradiance_source(example.info, example.folders()), Number::float64);
  for (const double y : {-1.0, -0.25, 0.0, 0.5, 1.0}) {
    const double x = std::sqrt(1 - y * y);
    const std::vector<double> v = run_module(values, Number::float64, {x, y, 0.0}, 1);
    REQUIRE(v.size() == 2);
    CHECK(v[0] + v[1] == 1.0);
    CHECK(v[0] - v[1] == y);
    // Inputs in the order of the module's own components
    std::vector<double> inputs(whole.input_components);
    for (std::uint32_t i = 0; i < whole.input_count; ++i) {
      const ShaderVariable& input = whole.inputs[i];
      if (std::string_view(input.name) == "direction")
        inputs[input.first_component] = x, inputs[input.first_component + 1] = y;
      else
        for (int c = 0; c < 6; ++c)
          inputs[input.first_component + std::uint32_t(c)] = 1 + c;  // sky 1 2 3, ground 4 5 6
    }
    const std::vector<double> e = run_module(whole, Number::float64, inputs, 1);
    REQUIRE(e.size() == 4);
    for (int c = 0; c < 3; ++c) CHECK(e[std::size_t(c)] == doctest::Approx((1 + c) * v[0] + (4 + c) * v[1]));
    CHECK(e[3] == 2);  // coefficients read
  }
}

TEST_CASE("a count in the registry that is not the file's BASIS_COUNT is refused with both") {
  Example example;
  for (const int count : {1, 3}) {
    example.info.count = count;
    const std::string message =
        "basis/sky_ground.glsl: BASIS_COUNT is 2, but BASIS(sky_ground, ...) in "
        "lighting/registry.def has a count of " +
        std::to_string(count) + ": write the same number in both";
    CHECK_THROWS_WITH_AS(technique_source(example.info, CoefficientStorage::volume, example.folders()), message.c_str(),
                         UserError);
    CHECK_THROWS_WITH_AS(basis_values_source(example.info, example.folders()), message.c_str(), UserError);
    CHECK_THROWS_WITH_AS(basis_irradiance_source(example.info, example.folders()), message.c_str(), UserError);
  }
}

}  // namespace twinshade
