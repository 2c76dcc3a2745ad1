#include "app/report/first_line_report.h"

#include <fmt/format.h>

#include "app/report/dialect.h"
#include "check/compare_rows.h"

namespace twinshade {
namespace {

std::vector<LintFinding> findings_at(const std::vector<LintFinding>& findings, const ProbedStatement& statement) {
  std::vector<LintFinding> list;
  for (const LintFinding& finding : findings)
    if (finding.file == statement.file && finding.line >= statement.line && finding.line <= statement.last_line)
      list.push_back(finding);
  return list;
}

}  // namespace

std::string components_text(Scalar scalar, const std::uint32_t* bits, std::uint32_t components) {
  std::string text;
  for (std::uint32_t c = 0; c < components; ++c) text += (c > 0 ? ", " : "") + value_text(scalar, bits[c]);
  return components == 1 ? text : "(" + text + ")";
}

std::string place_text(const ProbedStatement& statement) {
  return fmt::format("{}:{}{}", statement.file, statement.line,
                     statement.last_line > statement.line ? fmt::format("-{}", statement.last_line) : "");
}

std::string first_line_text(const FirstLine& first_line, const std::string& a, const std::string& b,
                            const std::vector<LintFinding>& findings) {
  if (!first_line.difference) return fmt::format("  first line that differs: {}\n", first_line.note);
  const LineDifference& d = *first_line.difference;
  std::string text = fmt::format("  first line that differs: {}: {}{}: {} {}, {} {}\n", place_text(d.statement),
                                 d.statement.what, d.occurrence > 1 ? fmt::format(", time {}", d.occurrence) : "", a,
                                 components_text(d.scalar, d.a.data(), d.components), b,
                                 components_text(d.scalar, d.b.data(), d.components));
  if (!d.cause.empty()) text += fmt::format("    {}: {}\n", place_text(d.statement), d.cause);
  for (const LintFinding& finding : findings_at(findings, d.statement)) text += "    " + describe(finding) + "\n";
  return text;
}

Json first_line_json(const FirstLine& first_line, const std::vector<LintFinding>& findings) {
  if (!first_line.difference) return {{"note", first_line.note}};
  const LineDifference& d = *first_line.difference;
  const auto values = [&](const std::array<std::uint32_t, 4>& bits) {
    Json list = Json::array();
    for (std::uint32_t c = 0; c < d.components; ++c) list.push_back(value_text(d.scalar, bits[c]));
    return list;
  };
  return {{"file", d.statement.file},
          {"line", d.statement.line},
          {"last_line", d.statement.last_line},
          {"value", d.statement.what},
          {"occurrence", d.occurrence},
          {"a", values(d.a)},
          {"b", values(d.b)},
          {"cause", d.cause.empty() ? Json(nullptr) : Json(d.cause)},
          {"findings", findings_json(findings_at(findings, d.statement))}};
}

}  // namespace twinshade
