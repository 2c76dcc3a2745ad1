// The table of rules and the walk that applies it to an expression.
#pragma once

#include <functional>
#include <string>

#include "cpu_shaders/lint/expression.h"
#include "cpu_shaders/lint/lint.h"

namespace twinshade::lint_detail {

using Report = std::function<void(const Expression& where, const LintRule& rule, const std::string& operation)>;

void apply_rules(const Expression& expression, const Report& report);

}  // namespace twinshade::lint_detail
