#include "evaluate/compare_outputs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace twinshade {
namespace {

constexpr std::uint64_t kNoUlp = UINT64_MAX;

// Floats in their order as integers; -0 and 0 are one.
std::int64_t place(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto magnitude = std::int64_t(bits & 0x7fffffffu);
  return (bits >> 31) != 0 ? -magnitude : magnitude;
}

std::uint64_t distance(double expected, double got, Scalar scalar) {
  if (scalar != Scalar::f32) return std::uint64_t(std::fabs(expected - got));
  if (std::isnan(expected) || std::isnan(got)) return std::isnan(expected) && std::isnan(got) ? 0 : kNoUlp;
  return std::uint64_t(std::llabs(place(float(expected)) - place(float(got))));
}

OutputDifference difference(double expected, double got, Scalar scalar) {
  OutputDifference d;
  d.expected = expected, d.got = got;
  d.ulp = distance(expected, got, scalar);
  const bool same = expected == got || (std::isnan(expected) && std::isnan(got));
  d.abs = same ? 0 : std::fabs(expected - got);
  d.rel = same ? 0 : d.abs / std::fabs(expected);
  return d;
}

bool close_enough(const OutputDifference& d, Scalar scalar, const Tolerance& tolerance) {
  if (d.discarded) return false;
  if (scalar != Scalar::f32) return d.expected == d.got;
  // Not the other way round: a NaN is within no distance.
  return d.ulp <= tolerance.ulp || (std::isfinite(d.expected) && (d.abs <= tolerance.abs || d.rel <= tolerance.rel));
}

double times_allowed(const OutputDifference& d, Scalar scalar, const Tolerance& tolerance) {
  if (!d.discarded && (scalar == Scalar::f32 ? d.ulp == 0 : d.expected == d.got)) return 0;
  double least = HUGE_VAL;
  const auto consider = [&](double distance, double allowed) {
    if (allowed > 0 && !std::isnan(distance)) least = std::min(least, distance / allowed);
  };
  if (d.discarded || scalar != Scalar::f32 || !std::isfinite(d.expected)) return least;
  if (d.ulp != kNoUlp) consider(double(d.ulp), double(tolerance.ulp));
  consider(d.abs, tolerance.abs);
  consider(d.rel, tolerance.rel);
  return least;
}

}  // namespace

OutputComparison compare_outputs(const Cases& cases, const EvaluatedRows& rows) {
  OutputComparison result;
  for (std::size_t row = 0; row < cases.table.rows; ++row) {
    const std::size_t before = result.failures.size();
    for (std::size_t k = 0; k < cases.expected.size(); ++k) {
      const ExpectedOutput& expected = cases.expected[k];
      const Values* got = find_values(rows.outputs, expected.values.name);
      TWINSHADE_CHECK_EQ(got != nullptr, true);
      if (expected.has_value[row] == 0) continue;
      const Scalar scalar = expected.values.type.scalar;
      for (std::uint32_t c = 0; c < expected.values.type.components(); ++c) {
        if (!expected.left_out.empty() && expected.left_out[row * expected.values.type.components() + c] != 0) continue;
        OutputDifference d;
        // Of floats what the file says is rounded, but for results in double.
        const double wanted =
            got->doubles.empty() && scalar == Scalar::f32
                ? double(std::bit_cast<float>(expected.values.bits[row * expected.values.type.components() + c]))
                : value_at(expected.values, row, c);
        if (rows.kept[row] != 0)
          d = difference(wanted, value_at(*got, row, c), scalar);
        else
          d.expected = wanted, d.discarded = true, d.ulp = kNoUlp;
        d.output = k, d.row = row, d.component = c;
        if (!result.worst || d.ulp > result.worst->ulp) result.worst = d;
        if (const double times = times_allowed(d, scalar, cases.tolerance); times > result.times_allowed)
          result.times_allowed = times, result.furthest = d;
        if (!close_enough(d, scalar, cases.tolerance)) result.failures.push_back(d);
      }
    }
    result.failed_rows += result.failures.size() > before;
  }
  return result;
}

}  // namespace twinshade
