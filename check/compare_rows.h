// What two machines computed for the rows of a table, bit by bit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/values.h"

namespace twinshade {

struct RowDifference {
  std::size_t row = 0;
  std::string output;  // "color.x"; "discard" where one machine discards
  Scalar scalar = Scalar::f32;
  std::uint32_t a = 0, b = 0;  // bits
  std::uint64_t ulp = 0;       // UINT64_MAX: NaN on one side, integers, discard
};

struct RowComparison {
  std::size_t compared = 0;            // rows
  std::size_t differ = 0;              // rows in which bits differ; NaN is one class
  std::size_t denormal_only = 0;       // of those, rows where each difference is a denormal against its zero
  std::uint64_t max_ulp = 0;           // over the others
  std::optional<RowDifference> first;  // of those others, or else of all
  std::vector<std::size_t> rows;       // that differ by more than flushed denormals
  std::size_t within = 0;              // rows that differ by no more than was allowed: not in `differ`
};

// leave_out: empty, or by row: not compared where true. allowed: the distance in ULP up to which a component does not
// differ (max_ulp is over all the same); none: every bit counts. Both results are of one shader and one table.
RowComparison compare_rows(const EvaluatedRows& a, const EvaluatedRows& b, const std::vector<bool>& leave_out = {},
                           std::optional<std::uint64_t> allowed = std::nullopt);

// By row: a float input or uniform is denormal.
std::vector<bool> rows_with_denormals(const ValueTable& table);

// The given rows, in the given order; uniforms that are the same for all stay so.
ValueTable select_rows(const ValueTable& table, const std::vector<std::size_t>& rows);

// "0.25 (0x1p-2)", "nan(0x7fc00000)", "-3", "true".
std::string value_text(Scalar scalar, std::uint32_t bits);

}  // namespace twinshade
