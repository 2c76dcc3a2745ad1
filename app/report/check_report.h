// What `check` found, for people, as JSON and as JUnit cases.
#pragma once

#include <string>
#include <vector>

#include "app/output.h"
#include "app/report/case_result.h"
#include "check/check_shader.h"

namespace twinshade {

// "same bits", "same to 3 ULP", "differs", "refused", "not run".
std::string verdict_text(const CheckedShader& shader);
// One line a shader.
std::string check_table(const std::vector<CheckedShader>& shaders);
// Everything else there is to say of a shader, indented; empty where there is nothing.
std::string describe_check(const CheckedShader& shader, bool make_exact);
Json check_json(const CheckedShader& shader, bool make_exact);
CaseResult check_result(const CheckedShader& shader, bool make_exact);

}  // namespace twinshade
