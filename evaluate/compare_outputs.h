// Outputs against what is expected of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/cases.h"

namespace twinshade {

struct OutputDifference {
  std::size_t output = 0;  // index into Cases::expected
  std::size_t row = 0;
  std::uint32_t component = 0;
  double expected = 0, got = 0;
  bool discarded = false;  // a value was expected, the shader discarded
  std::uint64_t ulp =
      0;  // between the floats; UINT64_MAX where one is NaN or nothing was written; integers: their distance
  double abs = 0, rel = 0;
};

struct OutputComparison {
  std::vector<OutputDifference> failures;  // beyond the tolerance, by row, then in the order of Cases::expected
  std::size_t failed_rows = 0;
  std::optional<OutputDifference> worst;  // of all values, by ULP; none where nothing is expected
  // The value that is furthest off by the tolerance's measure, and how many times what is allowed that is: up to 1
  // unless there are failures, infinite where no tolerance would do or none is given. None where all is as expected.
  std::optional<OutputDifference> furthest;
  double times_allowed = 0;
};

// check_expected must have passed. NaN is one class.
OutputComparison compare_outputs(const Cases& cases, const EvaluatedRows& rows);

}  // namespace twinshade
