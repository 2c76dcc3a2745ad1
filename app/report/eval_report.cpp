#include "app/report/eval_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/table.h"

namespace twinshade {
namespace {

constexpr std::size_t kMostListed = 8;  // failures of a case on a backend

std::string decimal(double value, Scalar scalar, bool is_double) {
  if (scalar == Scalar::boolean) return value != 0 ? "true" : "false";
  if (scalar != Scalar::f32) return fmt::format("{}", std::int64_t(value));
  return is_double ? fmt::format("{}", value) : fmt::format("{}", float(value));
}

std::string hex(double value, Scalar scalar) { return scalar == Scalar::f32 ? fmt::format("{:a}", value) : ""; }

std::string ulp_text(const OutputDifference& d) { return d.ulp == UINT64_MAX ? "" : std::to_string(d.ulp); }

Json number_json(double value, Scalar scalar) {
  if (scalar == Scalar::boolean) return value != 0;
  if (scalar != Scalar::f32) return std::int64_t(value);
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

std::string output_name(const EvaluatedCase& c, const OutputDifference& d) {
  const Values& expected = c.cases.expected[d.output].values;
  return component_name(expected.name, expected.type, d.component);
}

std::string result_text(const EvaluatedCase& c, const EvaluatedBackend& backend) {
  if (!backend.error.empty()) return backend.error;
  if (c.cases.expected.empty()) return "ran; nothing is expected";
  if (backend.comparison.failures.empty()) return "pass";
  return fmt::format("{} of {} rows fail", backend.comparison.failed_rows, c.cases.table.rows);
}

void add_values(Table& table, const char* kind, const Values& values, std::size_t row) {
  for (std::uint32_t i = 0; i < values.type.components(); ++i) {
    const double value = value_at({values.name, values.type, values.bits, {}}, values.row_count() == 1 ? 0 : row, i);
    table.row({"", std::string(kind) + " " + component_name(values.name, values.type, i),
               decimal(value, values.type.scalar, false), hex(value, values.type.scalar)});
  }
}

// The failures of a case on a backend: each row's outputs that are wrong, then what it was given.
std::string failures_text(const EvaluatedCase& c, const EvaluatedBackend& backend) {
  const std::vector<OutputDifference>& failures = backend.comparison.failures;
  Table table;
  table.column("row", Table::Align::right);
  table.column("value");
  table.column("is", Table::Align::right);
  table.column("", Table::Align::right);
  table.column("expected", Table::Align::right);
  table.column("", Table::Align::right);
  table.column("ULP", Table::Align::right);
  const std::size_t count = std::min(failures.size(), kMostListed);
  for (std::size_t i = 0; i < count; ++i) {
    const OutputDifference& d = failures[i];
    const Scalar scalar = c.cases.expected[d.output].values.type.scalar;
    const bool in_double = !backend.rows.outputs.empty() && !backend.rows.outputs[0].doubles.empty();
    table.row({std::to_string(d.row), output_name(c, d), d.discarded ? "discarded" : decimal(d.got, scalar, in_double),
               d.discarded ? "" : hex(d.got, scalar), decimal(d.expected, scalar, in_double), hex(d.expected, scalar),
               scalar == Scalar::f32 ? ulp_text(d) : ""});
    if (i + 1 < count && failures[i + 1].row == d.row) continue;
    for (const Values& values : c.cases.table.inputs) add_values(table, "  in", values, d.row);
    for (const Values& values : c.cases.table.uniforms) add_values(table, "  uniform", values, d.row);
  }
  std::string text = fmt::format("\n{} on {}:\n{}", c.name, backend.name, table.text());
  if (failures.size() > count) text += fmt::format("and {} more values\n", failures.size() - count);
  return text;
}

Json difference_json(const EvaluatedCase& c, const OutputDifference& d) {
  const Scalar scalar = c.cases.expected[d.output].values.type.scalar;
  Json json;
  json["output"] = output_name(c, d);
  json["row"] = d.row;
  json["expected"] = number_json(d.expected, scalar);
  json["got"] = d.discarded ? Json(nullptr) : number_json(d.got, scalar);
  if (scalar == Scalar::f32) {
    json["expected_hex"] = hex(d.expected, scalar);
    json["got_hex"] = d.discarded ? Json(nullptr) : Json(hex(d.got, scalar));
  }
  json["ulp"] = d.ulp == UINT64_MAX ? Json(nullptr) : Json(d.ulp);
  json["abs"] = d.discarded ? Json(nullptr) : number_json(d.abs, Scalar::f32);
  json["rel"] = d.discarded ? Json(nullptr) : number_json(d.rel, Scalar::f32);
  return json;
}

Json outputs_json(const EvaluatedRows& rows) {
  Json json = Json::object();
  for (const Values& values : rows.outputs) {
    Json& list = json[values.name] = Json::array();
    for (std::size_t row = 0; row < rows.kept.size(); ++row) {
      Json components = rows.kept[row] != 0 ? Json::array() : Json(nullptr);
      for (std::uint32_t i = 0; rows.kept[row] != 0 && i < values.type.components(); ++i)
        components.push_back(number_json(value_at(values, row, i), values.type.scalar));
      list.push_back(std::move(components));
    }
  }
  return json;
}

Json backend_json(const EvaluatedCase& c, const EvaluatedBackend& backend) {
  Json json = {{"name", backend.name}};
  if (!backend.error.empty()) {
    json["error"] = backend.error;
    return json;
  }
  json["outputs"] = outputs_json(backend.rows);
  json["failed_rows"] = backend.comparison.failed_rows;
  json["failed_values"] = backend.comparison.failures.size();
  json["worst"] = backend.comparison.worst ? difference_json(c, *backend.comparison.worst) : Json(nullptr);
  return json;
}

}  // namespace

bool EvaluatedCase::has_error() const {
  return !error.empty() ||
         std::any_of(backends.begin(), backends.end(), [](const auto& b) { return !b.error.empty(); });
}

bool EvaluatedCase::pass() const {
  return !has_error() &&
         std::all_of(backends.begin(), backends.end(), [](const auto& b) { return b.comparison.failures.empty(); });
}

std::string eval_text(const std::vector<EvaluatedCase>& cases, bool many) {
  Table table;
  table.column("shader");
  table.column("rows", Table::Align::right);
  table.column("on");
  table.column("result");
  std::string details;
  std::size_t passed = 0, errors = 0;
  for (const EvaluatedCase& c : cases) {
    passed += c.pass();
    errors += c.has_error();
    if (many && c.pass()) continue;
    if (!c.error.empty()) table.row({c.name, "", "", c.error});
    for (const EvaluatedBackend& backend : c.backends) {
      table.row({c.name, std::to_string(c.cases.table.rows), backend.name, result_text(c, backend)});
      if (!backend.comparison.failures.empty()) details += failures_text(c, backend);
    }
  }
  std::string text = table.empty() ? "" : table.text() + details;
  if (many)
    text += fmt::format("{}{} shader{}: {} passed, {} failed, {} with errors\n", table.empty() ? "" : "\n",
                        cases.size(), cases.size() == 1 ? "" : "s", passed, cases.size() - passed - errors, errors);
  return text;
}

Json eval_json(const std::vector<EvaluatedCase>& cases) {
  Json list = Json::array();
  for (const EvaluatedCase& c : cases) {
    Json json = {{"name", c.name}, {"rows", c.cases.table.rows}, {"pass", c.pass()}};
    if (!c.error.empty()) json["error"] = c.error;
    json["backends"] = Json::array();
    for (const EvaluatedBackend& backend : c.backends) json["backends"].push_back(backend_json(c, backend));
    list.push_back(std::move(json));
  }
  return list;
}

std::vector<CaseResult> eval_results(const std::vector<EvaluatedCase>& cases) {
  using Result = CaseResult::Result;
  std::vector<CaseResult> list;
  for (const EvaluatedCase& c : cases) {
    if (!c.error.empty()) {
      const bool of_cases = c.error.rfind(c.cases_file, 0) == 0;
      list.push_back({c.name, Result::error, c.error, "", 0, of_cases ? c.cases_file : c.file, 0});
    }
    for (const EvaluatedBackend& backend : c.backends) {
      const bool failed = !backend.comparison.failures.empty();
      const std::string message = failed || !backend.error.empty() ? result_text(c, backend) : "";
      list.push_back({c.name + " on " + backend.name,
                      !backend.error.empty() ? Result::error
                      : failed               ? Result::failed
                                             : Result::passed,
                      message, failed ? failures_text(c, backend) : "", backend.seconds, c.file, 0});
    }
  }
  return list;
}

}  // namespace twinshade
