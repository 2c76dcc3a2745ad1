// The first line of a shader whose value differs between two machines, found by running it with probes
// (cpu_shaders/rewrite/probe.h): once on one machine with all of them, which gives every value in the order of
// execution, then on the other with one at a time, so that its compiler is disturbed as little as can be, until none
// that is left could come before the first that differs. Statements that only copy, or are about integers, go together
// unless one of them differs.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "cpu_shaders/rewrite/probe.h"
#include "evaluate/evaluator.h"

namespace twinshade {

struct LineDifference {
  ProbedStatement statement;   // what: the value alone, "s.second", "P[2]"
  std::size_t time = 0;        // how many values were computed before it
  std::size_t occurrence = 1;  // which execution of the statement: 1 for the first
  Scalar scalar = Scalar::f32;
  std::uint32_t components = 1;
  std::array<std::uint32_t, 4> a{}, b{};
  std::string cause = {};  // where it is known, for the user: "int() of inf, ..."
};

struct FirstLine {
  std::optional<LineDifference> difference;
  std::string note;  // where there is none: why
};

// table: the group of rows (one, or a quad) that differs; row: of the group.
FirstLine first_differing_line(Evaluator& evaluator, const ShaderSource& source, const ValueTable& table,
                               std::size_t row, const EvaluationTarget& a, const EvaluationTarget& b);

}  // namespace twinshade
