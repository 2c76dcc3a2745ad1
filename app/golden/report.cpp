#include "app/golden/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/report/dialect.h"
#include "app/report/first_line_report.h"
#include "app/report/mismatch.h"

namespace twinshade {
namespace {

constexpr std::array<const char*, 10> kResultWords{"same",   "within",     "DIFFERS", "no image", "damaged",
                                                   "failed", "no backend", "added",   "changed",  "restored"};

const char* words(GoldenResult result) { return kResultWords[std::size_t(result)]; }

std::vector<std::string> changed_names(const GoldenChanges& changes) {
  std::vector<std::string> names;
  if (changes.drawing) names.emplace_back("options");
  if (changes.shader) names.emplace_back("shader");
  if (changes.bundle) names.emplace_back("bundle");
  return names;
}

std::string listed(const std::vector<std::string>& names, const char* none) {
  return names.empty() ? none : fmt::format("{}", fmt::join(names, ", "));
}

std::string place(const GoldenRow& row) {
  return row.folder + ": " + row.name + (row.on.empty() ? "" : " on " + row.on);
}

std::vector<std::string> difference_cells(const GoldenRow& row) {
  if (!row.comparison) return {"-", "-", "-"};
  const Comparison& c = *row.comparison;
  return {c.first ? c.first->layer : "-", std::to_string(c.pixels_differ),
          c.max_ulp == UINT64_MAX ? "NaN" : std::to_string(c.max_ulp)};
}

// What has changed, of a row that is drawn.
std::string changed_cell(const GoldenRow& row) {
  const bool other_frame = row.result == GoldenResult::differs || row.result == GoldenResult::changed;
  return listed(changed_names(row.changes), other_frame ? "nothing" : "-");
}

std::size_t longest(const std::vector<std::string>& names) {
  std::size_t most = 0;
  for (const std::string& name : names) most = std::max(most, name.size());
  return most;
}

std::size_t count(const std::vector<GoldenRow>& rows, GoldenResult result) {
  return std::size_t(std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return row.result == result; }));
}

void add_columns(Table& table) {
  table.column("result", Table::Align::left, 8);
  table.column("layer", Table::Align::left, 8);
  table.column("pixels", Table::Align::right, 8);
  table.column("max ULP", Table::Align::right, 10);
  table.column("changed");
}

}  // namespace

Table check_table(const std::vector<std::string>& names, const std::vector<std::string>& backends) {
  Table table;
  table.column("name", Table::Align::left, longest(names));
  table.column("on", Table::Align::left, longest(backends));
  add_columns(table);
  return table;
}

Table update_table(const std::vector<std::string>& names) {
  Table table;
  table.column("name", Table::Align::left, longest(names));
  add_columns(table);
  return table;
}

std::vector<std::string> check_cells(const GoldenRow& row) {
  std::vector<std::string> cells = update_cells(row);
  cells.insert(cells.begin() + 1, row.on);
  return cells;
}

std::vector<std::string> update_cells(const GoldenRow& row) {
  std::vector<std::string> cells{
      row.name, row.result == GoldenResult::within ? fmt::format("within {} ULP", row.ulp) : words(row.result)};
  for (std::string& cell : difference_cells(row)) cells.push_back(std::move(cell));
  cells.push_back(changed_cell(row));
  return cells;
}

std::string cause(const GoldenRow& row) {
  if (row.changes.shader && row.changes.bundle)
    return "the shader's source and the bundle (scene, camera, light or bake) have changed since the image was made";
  if (row.changes.shader) return "the shader's source has changed since the image was made";
  if (row.changes.bundle)
    return "the bundle (scene, camera, light or bake) has changed since the image was made, the shader has not";
  return "neither the shader's source nor the bundle has changed: the translator, the compiler, the driver or the "
         "machine has";
}

std::string failure_text(const GoldenRow& row) {
  if (row.passes()) return "";
  if (!row.error.empty()) return place(row) + ": " + row.error + '\n';
  return row.description + "  " + cause(row) + '\n' +
         (row.first_line ? first_line_text(*row.first_line, "cpu", row.on, row.findings) : "") +
         describe_findings(row.findings);
}

std::string check_summary(const std::vector<GoldenRow>& rows, std::uint64_t ulp) {
  std::string text = fmt::format("{} of {} the same", count(rows, GoldenResult::same), rows.size());
  if (const std::size_t within = count(rows, GoldenResult::within); within > 0)
    text += fmt::format(", {} within {} ULP", within, ulp);
  return text + '\n';
}

std::string update_summary(const std::vector<GoldenRow>& rows) {
  std::string text;
  for (const GoldenResult result :
       {GoldenResult::added, GoldenResult::changed, GoldenResult::restored, GoldenResult::same, GoldenResult::failed})
    if (const std::size_t number = count(rows, result); number > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, words(result));
  return text + '\n';
}

Json golden_json(const GoldenRow& row) {
  Json json{{"folder", row.folder}, {"name", row.name}};
  if (!row.on.empty()) json["on"] = row.on;
  json["result"] = words(row.result);
  if (row.result == GoldenResult::within) json["ulp"] = row.ulp;
  if (!row.error.empty()) json["error"] = row.error;
  if (row.comparison) add_comparison(json, *row.comparison, row.first_difference);
  json["changed"] = changed_names(row.changes);
  if (row.first_line) json["first_line"] = first_line_json(*row.first_line, row.findings);
  if (!row.findings.empty()) json["outside_exact_dialect"] = findings_json(row.findings);
  json["golden_frame"] = row.golden_frame.empty() ? Json(nullptr) : Json(row.golden_frame);
  json["frame"] = row.frame.empty() ? Json(nullptr) : Json(row.frame);
  if (row.on.empty()) json["image"] = row.written.empty() ? Json(nullptr) : Json(row.written);
  return json;
}

std::vector<CaseResult> golden_results(const std::vector<GoldenRow>& rows) {
  std::vector<CaseResult> cases;
  for (const GoldenRow& row : rows) {
    CaseResult c;
    c.name = place(row);
    c.seconds = row.seconds;
    c.file = row.shader_file.empty() ? manifest_path(row.folder) : row.shader_file;
    if (!row.passes()) {
      c.result = row.result == GoldenResult::no_backend ? CaseResult::Result::error : CaseResult::Result::failed;
      c.message = row.error;
      if (row.error.empty())
        c.message = fmt::format("{} of {} pixels differ from the golden image: {}", row.comparison->pixels_differ,
                                row.comparison->shaded_pixels, cause(row));
      c.text = row.error.empty() ? failure_text(row) : "";
      if (row.first_line && row.first_line->difference) {
        const ProbedStatement& first = row.first_line->difference->statement;
        c.message += "; first in " + place_text(first);
        c.file = first.file, c.line = first.line;
      }
      c.pictures = row.pictures;
    }
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace twinshade
