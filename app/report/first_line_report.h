// The first line of GLSL whose value differs between two machines, for people and as JSON.
#pragma once

#include <string>
#include <vector>

#include "app/output.h"
#include "check/first_line.h"
#include "cpu_shaders/lint/lint.h"

namespace twinshade {

// "1.5 (0x1.8p+0)", "(1 (0x1p+0), 2 (0x1p+1))".
std::string components_text(Scalar scalar, const std::uint32_t* bits, std::uint32_t components);
// "a.frag:3", "a.frag:3-5".
std::string place_text(const ProbedStatement& statement);

// Indented lines: the line, the value on both, why, and what the lint finds there. findings: of the shader.
std::string first_line_text(const FirstLine& first_line, const std::string& a, const std::string& b,
                            const std::vector<LintFinding>& findings);
// {"file", "line", "last_line", "value", "occurrence", "a", "b", "cause", "findings"}, or {"note"} where there is none.
Json first_line_json(const FirstLine& first_line, const std::vector<LintFinding>& findings);

}  // namespace twinshade
