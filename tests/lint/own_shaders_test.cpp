// Every shader of shaders/ is in the exact dialect.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <string_view>

#include "cpu_shaders/lint/lint.h"
#include "cpu_shaders/source/builtin_shaders.h"
#include "lighting/registry.h"
#include "lighting/sphere_maps.h"

namespace twinshade {
namespace {

void check_clean(const ShaderSource& source) {
  CAPTURE(source.name);
  for (const LintFinding& finding : lint(source)) FAIL_CHECK(describe(finding));
}

// What includers of files that fetch all layers say.
const std::string kCounts = "#define FETCHED_COLORS 7\n#define FETCHED_LAYERS 3\n#define SPHERE_MAP_COLORS 7\n";
constexpr int kCountLines = 3;

std::string include_line(std::string_view name) { return "#include \"" + std::string(name) + "\"\n"; }

}  // namespace

TEST_CASE("exact functions lint clean") {
  int count = 0;
  for (const std::string_view name : builtin_shader_names()) {
    if (name.substr(0, 6) != "exact/") continue;
    check_clean(resolve_shader(std::string(name), kCounts + include_line(name) + "void main() {}\n", "exact.frag"));
    ++count;
  }
  CHECK(count > 10);
}

TEST_CASE("bases lint clean, alone and in the techniques made of them") {
  int count = 0;
  for (const std::string_view name : builtin_shader_names()) {
    if (name.substr(0, 6) != "basis/") continue;
    if (name.find("lobe_functions") != name.npos) continue;  // part of the bases that define its lobe
    const std::string array = "uniform vec3 stored[64];\n#define COEF(i) stored[i]\n";
    check_clean(resolve_shader(std::string(name), array + include_line(name) + "void main() {}\n", "basis.frag"));
    ++count;
    if (name.find("functions") != name.npos || name.find("bands") != name.npos) continue;
    for (const std::string storage : {"lightmap", "vertex", "volume"}) {
      const std::string coefficients = "technique/coefficients_" + storage + ".glsl";
      const std::string surface = storage == "volume"             ? "technique/surface_world.glsl"
                                  : name == "basis/lightmap.glsl" ? "technique/surface_flat.glsl"
                                                                  : "technique/surface.glsl";
      check_clean(resolve_shader(std::string(name) + " " + storage,
                                 "#define COEFFICIENTS coefficients_test\n#define COEFFICIENT_COUNT 64\n" +
                                     include_line(surface) + include_line(coefficients) + include_line(name) +
                                     include_line("technique/irradiance_main.glsl"),
                                 "technique.frag"));
    }
  }
  CHECK(count > 40);
}

TEST_CASE("sphere maps lint clean, alone and as the host reads them") {
  int count = 0;
  for (const std::string_view name : builtin_shader_names()) {
    if (name.substr(0, 11) != "sphere_map/") continue;
    const std::string map = name.find("fetch_colors") != name.npos ? include_line("sphere_map/cube.glsl") : "";
    check_clean(resolve_shader(std::string(name), kCounts + map + include_line(name) + "void main() {}\n", "map.frag"));
    ++count;
  }
  CHECK(count >= 10);
  for (const SphereMapInfo& map : sphere_maps()) {
    check_clean(sphere_map_taps_source(map));
    check_clean(sphere_map_direction_source(map));
  }
}

TEST_CASE("products of spherical harmonics and visibility techniques lint clean") {
  int count = 0;
  for (const std::string_view name : builtin_shader_names()) {
    if (name.substr(0, 3) != "sh/") continue;
    check_clean(resolve_shader(std::string(name), include_line(name) + "void main() {}\n", "sh.frag"));
    ++count;
  }
  CHECK(count >= 3);
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.weights == VisibilityWeights::none) continue;
    for (const CoefficientStorage storage : {CoefficientStorage::lightmap, CoefficientStorage::vertex})
      for (const SphereMapInfo& map : sphere_maps()) check_clean(visibility_source(technique, storage, map));
  }
}

TEST_CASE("techniques of their own lint clean") {
  int count = 0;
  for (const std::string_view name : builtin_shader_names()) {
    if (std::filesystem::path(name).extension() != ".frag") continue;
    for (const char* storage : {"", "#define TWINSHADE_VERTEX_COEFFICIENTS\n"})
      check_clean(resolve_shader(std::string(name), storage + include_line(name), "technique.frag"));
    ++count;
  }
  CHECK(count >= 2);
}

// A line `precise T x = ... op ...`, op outside calls (whose arguments may be integers): the float arithmetic that its
// `precise` guards.
bool guards_arithmetic(const std::string& line) {
  static const std::regex declaration(R"(^ *precise \w+ \w+ = ([^;/]*(/ [^;/]*)?))"), call(R"(\w+\([^()]*\))");
  std::smatch match;
  if (!std::regex_search(line, match, declaration)) return false;
  const std::string value = std::regex_replace(match[1].str(), call, "f");
  return value.find_first_of("+*/") != value.npos || value.find(" - ") != value.npos;
}

TEST_CASE("taking any one `precise` away from the exact functions is found, at its line") {
  int removed = 0;
  for (const std::string_view name : builtin_shader_names()) {
    if (name.substr(0, 6) != "exact/") continue;
    const std::string text(*builtin_shader(name));
    int line_number = 1;
    for (std::size_t start = 0; start < text.size(); ++line_number) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const std::string line = text.substr(start, end - start);
      if (guards_arithmetic(line)) {
        std::string broken = text;
        broken.erase(start + line.find("precise "), 8);
        const auto findings = lint(resolve_shader("broken", kCounts + broken + "\nvoid main() {}\n", "broken.glsl"));
        CAPTURE(std::string(name));
        CAPTURE(line);
        CHECK(std::any_of(findings.begin(), findings.end(), [&](const LintFinding& finding) {
          return finding.file == "broken.glsl" && finding.line >= line_number + kCountLines &&
                 finding.rule != "literal";
        }));
        ++removed;
      }
      start = end + 1;
    }
  }
  CHECK(removed > 80);
}

}  // namespace twinshade
