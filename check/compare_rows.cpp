#include "check/compare_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "golden/compare_frames.h"

namespace twinshade {
namespace {

constexpr std::uint64_t kNoUlp = UINT64_MAX;

bool is_denormal(std::uint32_t bits) { return (bits & 0x7f800000u) == 0 && (bits & 0x007fffffu) != 0; }
bool is_zero(std::uint32_t bits) { return (bits & 0x7fffffffu) == 0; }

struct Pair {
  bool differ = false, flushed = false;
  std::uint64_t ulp = 0;
};

Pair compare(Scalar scalar, std::uint32_t a, std::uint32_t b) {
  if (a == b) return {};
  if (scalar != Scalar::f32) return {true, false, kNoUlp};
  const auto x = std::bit_cast<float>(a), y = std::bit_cast<float>(b);
  if (std::isnan(x) && std::isnan(y)) return {};
  const bool flushed = std::signbit(x) == std::signbit(y) && (is_zero(a) || is_zero(b)) &&
                       (is_denormal(a) || is_denormal(b));  // flushing keeps the sign
  return {true, flushed, ulp_distance(x, y)};
}

// Adds one row.
void add_row(RowComparison& result, const EvaluatedRows& a, const EvaluatedRows& b, std::size_t row,
             std::optional<std::uint64_t> allowed) {
  std::optional<RowDifference> first, first_flushed;
  bool within = false;
  if (a.kept[row] != b.kept[row])
    first = RowDifference{row, "discard", Scalar::boolean, a.kept[row] == 0u, b.kept[row] == 0u, kNoUlp};
  for (std::size_t o = 0; o < a.outputs.size() && a.kept[row] != 0 && b.kept[row] != 0; ++o) {
    const Values &x = a.outputs[o], &y = b.outputs[o];
    const std::uint32_t components = x.type.components();
    for (std::uint32_t c = 0; c < components; ++c) {
      const std::uint32_t p = x.bits[row * components + c], q = y.bits[row * components + c];
      const Pair pair = compare(x.type.scalar, p, q);
      if (!pair.differ) continue;
      if (!pair.flushed) result.max_ulp = std::max(result.max_ulp, pair.ulp);
      if (!pair.flushed && allowed && pair.ulp <= *allowed) {
        within = true;
        continue;
      }
      std::optional<RowDifference>& kept = pair.flushed ? first_flushed : first;
      if (!kept) kept = RowDifference{row, component_name(x.name, x.type, c), x.type.scalar, p, q, pair.ulp};
    }
  }
  if (!first && !first_flushed) {
    if (within) ++result.within;
    return;
  }
  ++result.differ;
  if (!first) ++result.denormal_only;
  const bool better = !result.first || (first && result.rows.empty());
  if (better) result.first = first ? first : first_flushed;
  if (first) result.rows.push_back(row);
}

}  // namespace

RowComparison compare_rows(const EvaluatedRows& a, const EvaluatedRows& b, const std::vector<bool>& leave_out,
                           std::optional<std::uint64_t> allowed) {
  TWINSHADE_CHECK_EQ(a.kept.size(), b.kept.size());
  TWINSHADE_CHECK_EQ(a.outputs.size(), b.outputs.size());
  RowComparison result;
  for (std::size_t row = 0; row < a.kept.size(); ++row) {
    if (row < leave_out.size() && leave_out[row]) continue;
    ++result.compared;
    add_row(result, a, b, row, allowed);
  }
  return result;
}

std::vector<bool> rows_with_denormals(const ValueTable& table) {
  std::vector<bool> found(table.rows);
  for (const std::vector<Values>* list : {&table.inputs, &table.uniforms})
    for (const Values& values : *list) {
      if (values.type.scalar != Scalar::f32) continue;
      const std::size_t components = values.type.components();
      for (std::size_t row = 0; row < table.rows; ++row) {
        const std::size_t at = values.row_count() == 1 ? 0 : row * components;
        for (std::size_t c = 0; c < components; ++c)
          if (is_denormal(values.bits[at + c])) found[row] = true;
      }
    }
  return found;
}

ValueTable select_rows(const ValueTable& table, const std::vector<std::size_t>& rows) {
  ValueTable selected = table;
  selected.rows = rows.size();
  for (std::vector<Values>* list : {&selected.inputs, &selected.uniforms})
    for (Values& values : *list) {
      const std::size_t components = values.type.components();
      if (list == &selected.uniforms && values.row_count() == 1) continue;
      std::vector<std::uint32_t> bits;
      for (const std::size_t row : rows)
        bits.insert(bits.end(), values.bits.begin() + std::ptrdiff_t(row * components),
                    values.bits.begin() + std::ptrdiff_t((row + 1) * components));
      values.bits = std::move(bits);
    }
  return selected;
}

std::string value_text(Scalar scalar, std::uint32_t bits) {
  switch (scalar) {
    case Scalar::i32:
      return std::to_string(std::int32_t(bits));
    case Scalar::u32:
      return std::to_string(bits) + "u";
    case Scalar::boolean:
      return bits != 0 ? "true" : "false";
    case Scalar::f32:
      break;
  }
  const auto value = std::bit_cast<float>(bits);
  if (std::isnan(value)) return fmt::format("nan(0x{:08x})", bits);
  return fmt::format("{} ({:a})", value, value);
}

}  // namespace twinshade
