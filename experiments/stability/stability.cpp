#include "experiments/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "base/error.h"
#include "base/names.h"
#include "base/parallel.h"
#include "experiments/stability/chart.h"
#include "experiments/stability/test.h"

namespace twinshade {
namespace {

struct StabilityTest {
  StabilityTestInfo info;
  std::vector<Finding> (*basis)(const TestedBasis&);  // null: not of bases
  std::vector<Finding> (*map)(const TestedMap&);      // null: not of sphere maps
  std::string_view none = {};                         // why it finds nothing of some bases
};

constexpr StabilityTest kTests[] = {
    {{"ringing", "least and greatest irradiance of a unit sun"}, test_ringing, nullptr},
    {{"constant", "what constant light comes back as"}, test_constant, test_map_constant},
    {{"finite", "NaN and infinity, inside the method's domain and outside"}, test_finite, test_map_finite},
    {{"rounding", "float against double"}, test_rounding, test_map_rounding},
    {{"jump", "differences between neighbouring normals: seams and creases"}, test_jump, test_map_jump},
    {{"storage", "coefficients rounded to half and to 8 bits"}, test_storage, nullptr},
    {{"light", "blended coefficients and small changes of the light, of methods that are not linear"},
     test_light,
     nullptr,
     "all of it is linear in the light"},
    {{"conditioning", "condition number of the Gram matrix"},
     test_conditioning,
     nullptr,
     "it is not linear, so it has no Gram matrix"},
    {{"reading", "how far off sphere maps are that store their texels' directions"}, nullptr, test_map_reading},
};

std::string hex_components(const glm::dvec3& v) { return fmt::format("{:a} {:a} {:a}", v.x, v.y, v.z); }

Cell hex_cell(const std::optional<glm::dvec3>& v) { return v ? Cell(hex_components(*v)) : Cell(); }

std::string rounded(const glm::dvec3& v) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", v.x, v.y, v.z); }

// For people: a line.
std::string input_text(const Finding& finding) {
  std::string text = finding.what;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (finding.light && finding.what.empty()) add("sun " + rounded(*finding.light));
  if (finding.normal) {
    // Far from unit length three decimals do not show it
    const double size =
        std::max({std::abs(finding.normal->x), std::abs(finding.normal->y), std::abs(finding.normal->z)});
    add("normal " + (size > 0.01 && size < 100 ? rounded(*finding.normal)
                                               : fmt::format("({:.3g}, {:.3g}, {:.3g})", finding.normal->x,
                                                             finding.normal->y, finding.normal->z)));
  }
  if (finding.other_normal) {
    const glm::dvec3 away = *finding.other_normal - *finding.normal;
    add(fmt::format("{:.1e} from its neighbour", std::sqrt(glm::dot(away, away))));
  }
  return text;
}

Cell coefficient_cell(const std::vector<double>& coefficients) {
  std::string text;
  for (const double value : coefficients) text += fmt::format("{}{:a}", text.empty() ? "" : " ", value);
  return text.empty() ? Cell() : Cell(text);
}

void add_row(Rows& rows, std::string_view method, const Finding& finding) {
  const std::string verdict(verdict_name(finding.verdict));
  const bool found = !finding.coefficients.empty() || finding.normal || !finding.what.empty();
  rows.add({std::string(method), finding.test, finding.measure, number_cell(finding.value), finding.unit,
            verdict.empty() ? Cell() : Cell(verdict), found ? Cell(input_text(finding)) : Cell(),
            hex_cell(finding.light), hex_cell(finding.normal), hex_cell(finding.other_normal),
            coefficient_cell(finding.coefficients)});
}

struct Method {
  std::string_view name;
  const TechniqueInfo* basis;  // or
  const SphereMapInfo* map;
};

bool is_asked_for(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

std::filesystem::path own_file(const StabilityOptions& options, const Method& method) {
  return std::filesystem::path(options.include_folder) / "basis" / method.basis->file;
}

// Whether one's own folder has the basis' file; without a folder all are as good as there.
bool has_file(const StabilityOptions& options, const Method& method) {
  if (options.include_folder.empty()) return true;
  std::error_code code;
  return method.basis && std::filesystem::is_regular_file(own_file(options, method), code);
}

std::vector<Method> chosen_methods(const StabilityOptions& options) {
  std::vector<Method> all, chosen;
  for (const TechniqueInfo& technique : techniques())
    if (technique.is_basis) all.push_back({technique.name, &technique, nullptr});
  for (const SphereMapInfo& map : sphere_maps()) all.push_back({map.name, nullptr, &map});
  std::vector<std::string> names;
  for (const Method& method : all) {
    names.emplace_back(method.name);
    if (!is_asked_for(options.methods, method.name)) continue;
    if (has_file(options, method))
      chosen.push_back(method);
    else if (!options.methods.empty())
      throw UserError(
          options.include_folder + ": has no " +
          (method.basis ? "basis/" + std::string(method.basis->file) + ", which is the file of " : "file of ") +
          std::string(method.name));
  }
  for (const std::string& name : options.methods) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    for (const TechniqueInfo& technique : techniques())
      if (technique.name == name)
        throw UserError("technique " + name +
                        " is no basis: stability tests bases and sphere maps (list bases, list maps)");
    throw UserError(unknown_name_message("basis or sphere map", name, names));
  }
  if (chosen.empty())
    throw UserError(options.include_folder +
                    ": has no file of a basis: put it under basis/, by the name of the built-in one (basis/h4.glsl)");
  return chosen;
}

std::vector<const StabilityTest*> chosen_tests(const StabilityOptions& options, const std::vector<Method>& methods) {
  std::vector<std::string> names;
  std::vector<const StabilityTest*> chosen;
  bool any = false;
  for (const StabilityTest& test : kTests) {
    names.emplace_back(test.info.name);
    if (!is_asked_for(options.tests, test.info.name)) continue;
    chosen.push_back(&test);
    for (const Method& method : methods) any = any || (method.basis ? test.basis != nullptr : test.map != nullptr);
  }
  for (const std::string& name : options.tests)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UserError(unknown_name_message("test", name, names));
  if (!any)
    throw UserError("test " + options.tests.front() + (methods.front().map ? " is of bases" : " is of sphere maps") +
                    ": " + std::string(methods.front().name) + " cannot be put to it");
  return chosen;
}

}  // namespace

std::span<const StabilityTestInfo> stability_tests() {
  static const std::vector<StabilityTestInfo> infos = [] {
    std::vector<StabilityTestInfo> list;
    for (const StabilityTest& test : kTests) list.push_back(test.info);
    return list;
  }();
  return infos;
}

ExperimentResult run_stability(const StabilityOptions& options) {
  const std::vector<Method> methods = chosen_methods(options);
  const std::vector<const StabilityTest*> tests = chosen_tests(options, methods);
  std::vector<std::vector<Finding>> findings(methods.size());
  std::vector<std::string> folders;
  if (!options.include_folder.empty()) folders.push_back(options.include_folder);
  std::mutex mutex;
  parallel_for(methods.size(), [&](std::size_t m, int) {
    const Method& method = methods[m];
    const auto put_to = [&](const auto& tested, auto StabilityTest::*test) {
      for (const StabilityTest* one : tests) {
        if (!(one->*test)) continue;
        {
          const std::lock_guard lock(mutex);
          options.progress(fmt::format("{}: {}", method.name, one->info.name));
        }
        for (Finding& finding : (one->*test)(tested)) findings[m].push_back(std::move(finding));
      }
    };
    if (method.basis)
      put_to(TestedBasis(*method.basis, options.seed, folders), &StabilityTest::basis);
    else
      put_to(TestedMap(*method.map), &StabilityTest::map);
  });
  ExperimentResult result{Rows({"method", "test", "measure", "value", "unit", "verdict", "input", "light", "normal",
                                "other_normal", "coefficients"}),
                          {},
                          {}};
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (const Finding& finding : findings[m]) add_row(result.rows, methods[m].name, finding);
  if (!options.methods.empty())
    for (std::size_t m = 0; m < methods.size(); ++m)
      for (const StabilityTest* test : tests)
        if (!test->none.empty() && methods[m].basis &&
            std::none_of(findings[m].begin(), findings[m].end(),
                         [&](const Finding& finding) { return finding.test == test->info.name; }))
          result.notes.push_back(fmt::format("{} has no row for {}: {}", methods[m].name, test->info.name, test->none));
  if (options.pictures) result.pictures = stability_charts(result.rows);
  return result;
}

bool stability_fails(const Rows& rows) {
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows.at(row, "verdict") == Cell(std::string(verdict_name(Verdict::fails)))) return true;
  return false;
}

}  // namespace twinshade
