// Where a shader leaves the exact dialect, for people and as JSON.
#pragma once

#include <string>
#include <vector>

#include "app/output.h"
#include "cpu_shaders/lint/lint.h"

namespace twinshade {

// What the lint finds, in files as they are called.
std::vector<LintFinding> findings_of(const ShaderSource& source);
// Indented lines, the first few findings; empty where there are none.
std::string describe_findings(const std::vector<LintFinding>& findings);
Json findings_json(const std::vector<LintFinding>& findings);

}  // namespace twinshade
