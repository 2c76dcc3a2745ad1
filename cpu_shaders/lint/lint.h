// Where a shader leaves the exact dialect: the closed list of operations whose bits are the same on every machine
// (docs/exact-dialect.md). Works on the preprocessed text, before any compiler folds constants.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct LintFinding {
  std::string file;  // as in ShaderSource::files
  int line = 0;
  std::string rule;       // LintRule::id
  std::string operation;  // what was met: "*", "dot", "0.1" ...
  std::string message;    // why it matters and what to write instead

  bool operator==(const LintFinding&) const = default;
};

struct LintRule {
  std::string_view id;
  std::string_view message;
};

// In the order of the text, each (line, rule, operation) once. UserError where the shader is not valid GLSL.
std::vector<LintFinding> lint(const ShaderSource& source);

// The table. One row per rule.
std::span<const LintRule> lint_rules();

// "file:line: operation: message [rule]"
std::string describe(const LintFinding& finding);

}  // namespace twinshade
