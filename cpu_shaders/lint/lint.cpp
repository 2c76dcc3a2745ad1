#include "cpu_shaders/lint/lint.h"

#include <algorithm>

#include "cpu_shaders/lint/parser.h"
#include "cpu_shaders/lint/rules.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {

std::vector<LintFinding> lint(const ShaderSource& source) {
  compile_glsl(source);  // the parser below relies on valid GLSL
  const TokenList tokens = lint_detail::tokens_to_parse(source);
  std::vector<LintFinding> findings;
  const auto report = [&](const lint_detail::Expression& where, const LintRule& rule, const std::string& operation) {
    LintFinding finding{tokens.files[static_cast<std::size_t>(where.file)], where.line, std::string(rule.id), operation,
                        std::string(rule.message)};
    if (std::find(findings.begin(), findings.end(), finding) == findings.end()) findings.push_back(std::move(finding));
  };
  struct Rules : lint_detail::Listener {
    lint_detail::Report report;
    void expression(const lint_detail::Expression& e, Role) override { lint_detail::apply_rules(e, report); }
  } rules;
  rules.report = report;
  lint_detail::Parser(tokens, rules).run();
  return findings;
}

std::string describe(const LintFinding& finding) {
  return finding.file + ":" + std::to_string(finding.line) + ": " + finding.operation + ": " + finding.message + " [" +
         finding.rule + "]";
}

}  // namespace twinshade
