#include "app/report/dialect.h"

#include <fmt/format.h>

#include "cpu_shaders/source/line_names.h"

namespace twinshade {

std::vector<LintFinding> findings_of(const ShaderSource& source) {
  std::vector<LintFinding> findings = lint(source);
  for (LintFinding& finding : findings) finding.file = with_real_names(source.files, finding.file);
  return findings;
}

std::string describe_findings(const std::vector<LintFinding>& findings) {
  constexpr std::size_t kShown = 12;
  if (findings.empty()) return "";
  std::string text = "  the shader leaves the exact dialect, which explains differences in shading, at:\n";
  for (std::size_t i = 0; i < findings.size() && i < kShown; ++i) text += "    " + describe(findings[i]) + '\n';
  if (findings.size() > kShown) text += fmt::format("    and {} more places\n", findings.size() - kShown);
  return text;
}

Json findings_json(const std::vector<LintFinding>& findings) {
  Json json = Json::array();
  for (const LintFinding& finding : findings)
    json.push_back({{"file", finding.file},
                    {"line", finding.line},
                    {"rule", finding.rule},
                    {"operation", finding.operation},
                    {"message", finding.message}});
  return json;
}

}  // namespace twinshade
