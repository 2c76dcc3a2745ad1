#include "experiments/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "base/names.h"
#include "base/parallel.h"
#include "experiments/stability_chart.h"
#include "experiments/stability_test.h"

namespace twinshade {
namespace {

struct BasisTest {
  StabilityTestInfo info;
  std::vector<Finding> (*run)(const TestedBasis&);
};

constexpr BasisTest kTests[] = {
    {{"ringing", "least and greatest irradiance of a unit sun"}, test_ringing},
    {{"constant", "what constant light comes back as"}, test_constant},
    {{"finite", "NaN and infinity, inside the method's domain and outside"}, test_finite},
    {{"rounding", "float against double"}, test_rounding},
    {{"jump", "differences between neighbouring normals: seams and creases"}, test_jump},
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
  const bool found = !finding.coefficients.empty() || finding.normal;
  rows.add({std::string(method), finding.test, finding.measure, number_cell(finding.value), finding.unit,
            verdict.empty() ? Cell() : Cell(verdict), found ? Cell(input_text(finding)) : Cell(),
            hex_cell(finding.light), hex_cell(finding.normal), hex_cell(finding.other_normal),
            coefficient_cell(finding.coefficients)});
}

std::vector<const TechniqueInfo*> chosen_methods(const StabilityOptions& options) {
  std::vector<const TechniqueInfo*> chosen;
  std::vector<std::string> names;
  for (const TechniqueInfo& technique : techniques())
    if (technique.is_basis) names.emplace_back(technique.name);
  for (const std::string& name : options.methods) {
    const auto same = [&](const TechniqueInfo& technique) { return technique.name == name; };
    if (std::any_of(techniques().begin(), techniques().end(),
                    [&](const TechniqueInfo& technique) { return same(technique) && !technique.is_basis; }))
      throw UserError("technique " + name +
                      " is no basis: stability tests what bases make of normals and coefficients (list bases)");
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UserError(unknown_name_message("basis", name, names));
  }
  for (const TechniqueInfo& technique : techniques())
    if (technique.is_basis && (options.methods.empty() || std::find(options.methods.begin(), options.methods.end(),
                                                                    technique.name) != options.methods.end()))
      chosen.push_back(&technique);
  return chosen;
}

std::vector<const BasisTest*> chosen_tests(const StabilityOptions& options) {
  std::vector<std::string> names;
  for (const BasisTest& test : kTests) names.emplace_back(test.info.name);
  for (const std::string& name : options.tests)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UserError(unknown_name_message("test", name, names));
  std::vector<const BasisTest*> chosen;
  for (const BasisTest& test : kTests)
    if (options.tests.empty() ||
        std::find(options.tests.begin(), options.tests.end(), test.info.name) != options.tests.end())
      chosen.push_back(&test);
  return chosen;
}

}  // namespace

std::span<const StabilityTestInfo> stability_tests() {
  static const std::vector<StabilityTestInfo> infos = [] {
    std::vector<StabilityTestInfo> list;
    for (const BasisTest& test : kTests) list.push_back(test.info);
    return list;
  }();
  return infos;
}

ExperimentResult run_stability(const StabilityOptions& options) {
  const std::vector<const TechniqueInfo*> bases = chosen_methods(options);
  const std::vector<const BasisTest*> tests = chosen_tests(options);
  std::vector<std::vector<Finding>> findings(bases.size());
  std::mutex mutex;
  parallel_for(bases.size(), [&](std::size_t b, int) {
    const TestedBasis tested(*bases[b], options.seed);
    for (const BasisTest* test : tests) {
      {
        const std::lock_guard lock(mutex);
        options.progress(fmt::format("{}: {}", bases[b]->name, test->info.name));
      }
      for (Finding& finding : test->run(tested)) findings[b].push_back(std::move(finding));
    }
  });
  ExperimentResult result{Rows({"method", "test", "measure", "value", "unit", "verdict", "input", "light", "normal",
                                "other_normal", "coefficients"}),
                          {},
                          {}};
  for (std::size_t b = 0; b < bases.size(); ++b)
    for (const Finding& finding : findings[b]) add_row(result.rows, bases[b]->name, finding);
  if (options.pictures) result.pictures = stability_charts(result.rows);
  return result;
}

bool stability_fails(const Rows& rows) {
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows.at(row, "verdict") == Cell(std::string(verdict_name(Verdict::fails)))) return true;
  return false;
}

}  // namespace twinshade
