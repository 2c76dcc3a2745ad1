#include "app/report/compare_report.h"

#include <fmt/format.h>

#include "app/options.h"
#include "app/report/dialect.h"
#include "app/report/first_line_report.h"
#include "app/report/mismatch.h"

namespace twinshade {
namespace {

bool only_softpipe_denormals(const ComparedShader& row) {
  return row.b == "softpipe" && row.comparison.pixels_differ == row.comparison.denormal_only;
}

std::string verdict(const ComparedShader& row) {
  if (!row.failure.empty()) return "failed";
  if (row.comparison.equal()) return "equal";
  if (row.is_mismatch()) return "DIFFERS";
  return row.attributes == AttributeMode::native ? "differs (native)" : "denormals only";
}

Json name_or_null(const std::string& name) { return name.empty() ? Json(nullptr) : Json(name); }

}  // namespace

bool ComparedShader::is_mismatch() const {
  return attributes == AttributeMode::exact && failure.empty() && !comparison.equal() &&
         !only_softpipe_denormals(*this);
}

std::vector<std::string> compared_cells(const ComparedShader& row) {
  std::vector<std::string> cells{row.name(), row.light.empty() ? "-" : row.light, row.map.empty() ? "-" : row.map,
                                 row.a, row.b};
  const Comparison& c = row.comparison;
  if (!row.failure.empty()) {
    cells.resize(13, "-");
  } else {
    for (const std::uint64_t count : {c.shaded_pixels, c.coverage_differs, c.id_differs, c.depth_differs,
                                      c.attributes_differ, c.pixels_differ, c.denormal_only})
      cells.push_back(std::to_string(count));
    cells.push_back(c.max_ulp == UINT64_MAX ? "NaN" : std::to_string(c.max_ulp));
  }
  cells.push_back(verdict(row));
  return cells;
}

Json compared_json(const ComparedShader& row) {
  Json json{{"technique", row.technique},
            {"light", name_or_null(row.light)},
            {"map", name_or_null(row.map)},
            {"a", row.a},
            {"b", row.b},
            {"output", name_or_null(row.output)},
            {"attributes", attribute_mode_name(row.attributes)}};
  if (!row.failure.empty()) {
    json["error"] = row.failure;
    return json;
  }
  add_comparison(json, row.comparison, row.first_difference);
  json["first_line"] = row.first_line ? first_line_json(*row.first_line, row.findings) : Json(nullptr);
  json["outside_exact_dialect"] = findings_json(row.findings);
  json["verdict"] = verdict(row);
  json["a_frame"] = row.hash_a;
  json["b_frame"] = row.hash_b;
  return json;
}

std::vector<CaseResult> compared_results(const std::vector<ComparedShader>& rows, const std::string& shader_file) {
  std::vector<CaseResult> cases;
  for (const ComparedShader& row : rows) {
    CaseResult c;
    c.name = row.name();
    for (const std::string& part : {row.light, row.map})
      if (!part.empty()) c.name += ", " + part;
    c.name += fmt::format(": {} and {}", row.a, row.b);
    c.file = shader_file;
    if (!row.failure.empty()) {
      c.result = CaseResult::Result::error;
      c.message = row.failure;
    } else if (row.is_mismatch()) {
      c.result = CaseResult::Result::failed;
      c.message = fmt::format("{} of {} pixels differ", row.comparison.pixels_differ, row.comparison.shaded_pixels);
      c.text = row.description;
      c.pictures = row.pictures;
      if (row.first_line && row.first_line->difference) {
        const ProbedStatement& first = row.first_line->difference->statement;
        c.message += ", first in " + place_text(first);
        c.file = first.file, c.line = first.line;
      }
    }
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace twinshade
