// Which lines of a shader could be computed in 16 bits: each tried by itself over rows of values, then as many as stay
// within a tolerance together.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/cases.h"
#include "evaluate/compare_outputs.h"
#include "evaluate/evaluator.h"

namespace twinshade {

// What a shader gives with some of its lines in half.
struct HalfResult {
  // Times the tolerance that the worst value is off; infinite: one that is not finite where another is expected, a bool
  // or integer that is another, a row that is discarded or no longer is, a loop that does not end.
  double off = 0;
  std::optional<OutputDifference> worst;  // none where all is as expected, and where `other` says what is not
  std::string other;                      // "does not end", "discards row 3", "keeps row 3", which float discards
};

struct HalfLine {
  std::string file;
  int line = 0;
  HalfResult alone;       // with this line alone in half
  bool together = false;  // it is among those that can be in half at once
};

struct HalfLines {
  std::vector<HalfLine> lines;         // by file and line, the shader's own file first
  HalfResult together, all;            // with all of those; with every line
  std::optional<HalfResult> declared;  // ES alone: as its qualifiers have it (Precision::mediump)
  std::size_t rows = 0, left_out = 0;  // left out: nothing is expected of any output
  std::vector<std::string> unjudged;   // components of outputs of which nothing is expected in any row
};

// What is expected of a shader that has no cases: what float gives, but where that is not finite.
Cases cases_of_float(Evaluator& evaluator, const ShaderSource& shader, const ValueTable& table,
                     const EvaluationTarget& target, const Tolerance& tolerance);

// Each line by itself; then, from the least harmful on, those that still leave all values within `cases.tolerance`
// together with those before them: not always the largest set. done: called with how many runs are behind, and how many
// there are at most. UserError as of Evaluator::run and check_expected, where float itself is beyond the tolerance, and
// where nothing is expected of anything.
HalfLines find_half_lines(Evaluator& evaluator, ShaderSource shader, Cases cases, const EvaluationTarget& target,
                          const std::string& cases_file,
                          const std::function<void(std::size_t done, std::size_t all)>& done = {});

}  // namespace twinshade
