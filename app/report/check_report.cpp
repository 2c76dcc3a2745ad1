#include "app/report/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/dialect.h"
#include "app/report/first_line_report.h"
#include "app/report/table.h"

namespace twinshade {
namespace {

std::string ulp_text(std::uint64_t ulp) {
  if (ulp == 0) return "the sign of zero alone";
  return ulp == UINT64_MAX ? "no distance in ULP" : fmt::format("{} ULP", ulp);
}

// Of the row that differs; of the whole quad where there is one.
std::string input_text(const Counterexample& example) {
  std::string text;
  for (const std::vector<Values>* list : {&example.values.inputs, &example.values.uniforms})
    for (const Values& values : *list) {
      const std::uint32_t components = values.type.components();
      const bool uniform = list == &example.values.uniforms;
      text += fmt::format("    {}{} =", uniform ? "uniform " : "", values.name);
      const std::size_t rows = uniform ? 1 : values.row_count();
      for (std::size_t row = 0; row < rows; ++row)
        text += fmt::format("{} {}", row > 0 ? ";" : "",
                            components_text(values.type.scalar, &values.bits[row * components], components));
      text += rows > 1 ? "  (the four rows of a quad)\n" : "\n";
    }
  return text;
}

std::string counterexample_text(const CheckedShader& shader) {
  const Counterexample& example = *shader.counterexample;
  const RowDifference& d = example.difference;
  std::string text =
      fmt::format("  {}: {} {}, {} {}: {}\n", d.output, backend_name(example.a), value_text(d.scalar, d.a),
                  backend_name(example.b), value_text(d.scalar, d.b), ulp_text(d.ulp));
  text += "  smallest input that shows it:\n" + input_text(example) +
          first_line_text(example.first_line, backend_name(example.a), backend_name(example.b), shader.findings);
  if (example.constant_folding)
    text +=
        "  cause: constant folding; it is gone when neither compiler computes constants (glslang does in double, Mesa "
        "in "
        "float)\n";
  return text;
}

std::string rows_text(const BackendCheck& check, bool reference) {
  if (!check.not_run.empty()) return "not run";
  if (reference) return "reference";
  const RowComparison& c = check.comparison;
  if (c.differ == 0) return c.within == 0 ? "same bits" : fmt::format("same to {} ULP", c.max_ulp);
  std::string text = fmt::format("{} of {} rows", c.differ, c.compared);
  if (c.denormal_only > 0) text += fmt::format(" ({} denormal only)", c.denormal_only);
  return text;
}

// Of one row.
Json row_json(const Values& values, std::size_t row) {
  Json list = Json::array();
  const std::uint32_t components = values.type.components();
  for (std::uint32_t c = 0; c < components; ++c)
    list.push_back(value_text(values.type.scalar, values.bits[row * components + c]));
  return list;
}

Json values_json(const Counterexample& example) {
  Json list = Json::array();
  for (const std::vector<Values>* kind : {&example.values.inputs, &example.values.uniforms})
    for (const Values& values : *kind) {
      const bool uniform = kind == &example.values.uniforms;
      Json json = {{"name", values.name},
                   {"type", type_name(values.type)},
                   {"uniform", uniform},
                   {"value", row_json(values, uniform ? 0 : example.row)}};
      if (!uniform && values.row_count() > 1)  // without the rows beside it there is no difference to see
        for (std::size_t row = 0; row < values.row_count(); ++row) json["quad"].push_back(row_json(values, row));
      list.push_back(std::move(json));
    }
  return list;
}

Json counterexample_json(const CheckedShader& shader) {
  if (!shader.counterexample) return nullptr;
  const Counterexample& example = *shader.counterexample;
  const RowDifference& d = example.difference;
  return {{"a", backend_name(example.a)},
          {"b", backend_name(example.b)},
          {"output", d.output},
          {"a_value", value_text(d.scalar, d.a)},
          {"b_value", value_text(d.scalar, d.b)},
          {"ulp", ulp_json(d.ulp)},
          {"inputs", values_json(example)},
          {"first_line", first_line_json(example.first_line, shader.findings)},
          {"constant_folding", example.constant_folding}};
}

}  // namespace

std::string verdict_text(const CheckedShader& shader) {
  switch (shader.verdict) {
    case Verdict::same_bits:
      return "same bits";
    case Verdict::same_to_ulp:
      return fmt::format("same to {} ULP", shader.max_ulp);
    case Verdict::differs:
      return "differs";
    case Verdict::refused:
      return "refused";
    case Verdict::not_run:
      return "not run";
  }
  return "";
}

std::string check_table(const std::vector<CheckedShader>& shaders) {
  Table table;
  table.column("shader");
  table.column("verdict");
  std::vector<std::string> names;
  for (const CheckedShader& shader : shaders)
    for (const BackendCheck& check : shader.backends)
      if (const std::string name = backend_name(check.target.backend);
          std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
        table.column(name);
        table.column("ns", Table::Align::right);
      }
  for (const CheckedShader& shader : shaders) {
    std::vector<std::string> cells{shader.path, verdict_text(shader)};
    for (const std::string& name : names) {
      const auto found = std::find_if(shader.backends.begin(), shader.backends.end(), [&](const BackendCheck& check) {
        return backend_name(check.target.backend) == name;
      });
      const bool run = found != shader.backends.end();
      cells.push_back(run ? rows_text(*found, found == shader.backends.begin()) : "");
      cells.push_back(run && found->ns_per_invocation > 0 ? fmt::format("{:.1f}", found->ns_per_invocation) : "");
    }
    table.row(cells);
  }
  return table.text();
}

std::string describe_check(const CheckedShader& shader, bool make_exact) {
  std::string text;
  if (!shader.message.empty()) text += "  " + shader.message + "\n";
  for (const BackendCheck& check : shader.backends)
    if (!check.not_run.empty() && check.not_run != shader.message) text += "  " + check.not_run + "\n";
  if (shader.counterexample) text += counterexample_text(shader);
  constexpr std::size_t kShown = 12;
  if (!shader.findings.empty()) text += make_exact ? "  could not be made exact:\n" : "  outside the exact dialect:\n";
  for (std::size_t i = 0; i < shader.findings.size() && i < kShown; ++i)
    text += "    " + describe(shader.findings[i]) + "\n";
  if (shader.findings.size() > kShown) text += fmt::format("    and {} more places\n", shader.findings.size() - kShown);
  return text.empty() ? "" : shader.path + ": " + verdict_text(shader) + "\n" + text;
}

Json check_json(const CheckedShader& shader, bool make_exact) {
  Json backends = Json::array();
  for (const BackendCheck& check : shader.backends) {
    const RowComparison& c = check.comparison;
    backends.push_back(
        {{"name", backend_name(check.target.backend)},
         {"not_run", check.not_run.empty() ? Json(nullptr) : Json(check.not_run)},
         {"rows", c.compared},
         {"rows_differ", c.differ},
         {"denormal_only", c.denormal_only},
         {"max_ulp", ulp_json(c.max_ulp)},
         {"ns_per_invocation", check.ns_per_invocation > 0 ? Json(check.ns_per_invocation) : Json(nullptr)}});
  }
  return {{"shader", shader.path},
          {"verdict", verdict_text(shader)},
          {"message", shader.message.empty() ? Json(nullptr) : Json(shader.message)},
          {"max_ulp", ulp_json(shader.max_ulp)},
          {"backends", backends},
          {"counterexample", counterexample_json(shader)},
          {make_exact ? "not_made_exact" : "outside_exact_dialect", findings_json(shader.findings)}};
}

CaseResult check_result(const CheckedShader& shader, bool make_exact) {
  CaseResult result;
  result.name = shader.path;
  result.file = shader.path;
  result.files = shader.files;
  result.files.push_back(shader.path);
  result.seconds = shader.seconds;
  if (shader.verdict == Verdict::same_bits || shader.verdict == Verdict::same_to_ulp) return result;
  result.result = shader.verdict == Verdict::differs ? CaseResult::Result::failed : CaseResult::Result::error;
  result.text = describe_check(shader, make_exact);
  result.message = shader.message.empty() ? verdict_text(shader) : shader.message;
  if (shader.counterexample && shader.counterexample->first_line.difference) {
    const ProbedStatement& first = shader.counterexample->first_line.difference->statement;
    result.message += " from " + place_text(first);
    result.file = first.file, result.line = first.line;
  }
  return result;
}

}  // namespace twinshade
