// Which lines of a shader could be computed in 16 bits: each tried by itself over rows of values, then as many as stay
// within a tolerance together.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluate/cases.h"
#include "evaluate/evaluator.h"

namespace twinshade {

struct HalfLine {
  std::string file;
  int line = 0;
  // Times the tolerance that the worst value is off, with this line alone in half; infinite: a value that is not finite
  // where another is expected, a bool or integer that is another, a row that is discarded or no longer is.
  double alone = 0;
  bool together = false;  // it is among those that can be in half at once
};

struct HalfLines {
  std::vector<HalfLine> lines;         // by file and line, the shader's own file first
  double together = 0;                 // times the tolerance, with all of those
  double all = 0;                      // ... with every line
  std::size_t rows = 0, left_out = 0;  // left out: where float itself gives no finite value
};

// What is expected of a shader that has no cases: what float gives, but where that is not finite.
Cases cases_of_float(Evaluator& evaluator, const ShaderSource& shader, const ValueTable& table,
                     const EvaluationTarget& target, const Tolerance& tolerance);

// Each line by itself; then, from the least harmful on, those that still leave all values within `cases.tolerance`
// together with those before them: not always the largest set. done: called with how many runs are behind, and how many
// there are at most. UserError as of Evaluator::run and check_expected, and where float itself is beyond the tolerance.
HalfLines find_half_lines(Evaluator& evaluator, ShaderSource shader, Cases cases, const EvaluationTarget& target,
                          const std::string& cases_file,
                          const std::function<void(std::size_t done, std::size_t all)>& done = {});

}  // namespace twinshade
