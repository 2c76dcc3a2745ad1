// The smallest input that still shows a difference: values become zero, one, small integers or short fractions as long
// as the two machines still differ (after Zeller and Hildebrandt, Simplifying and isolating failure-inducing input,
// 2002, by values).
#pragma once

#include <functional>
#include <vector>

#include "check/input_ranges.h"
#include "evaluate/values.h"

namespace twinshade {

// By group of `group` rows: whether the machines differ in it.
using Differs = std::function<std::vector<bool>(const ValueTable& rows)>;

// failing: one group of rows (one row, or the four of a quad) that differs. Values stay within the ranges that were
// declared.
ValueTable shrink(const ValueTable& failing, const std::vector<InputRange>& ranges, const Differs& differs);

// How much there is to read in a value: 0 for zero, then one, small integers, fractions of few bits.
int complexity(Scalar scalar, std::uint32_t bits);

}  // namespace twinshade
