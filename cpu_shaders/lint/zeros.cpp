#include "cpu_shaders/lint/zeros.h"

#include <algorithm>

namespace twinshade::lint_detail {
namespace {

// All scalars of a vector or matrix, in order.
void append_scalars(const Zeros& zeros, int count, std::vector<Zeros>& scalars) {
  if (!zeros.parts) return scalars.resize(scalars.size() + std::size_t(count), count == 1 ? zeros : Zeros{});
  const int each = count / static_cast<int>(std::max<std::size_t>(zeros.parts->size(), 1));
  for (const Zeros& part : *zeros.parts) append_scalars(part, each, scalars);
}

Zeros column_zeros(const std::vector<Zeros>& scalars, int column, int rows) {
  const auto first = scalars.begin() + std::ptrdiff_t(column) * rows;
  return composed_zeros({first, first + rows});
}

}  // namespace

Zeros scalar_zeros(bool is_zero) { return {is_zero, is_zero, nullptr}; }

Zeros composed_zeros(std::vector<Zeros> parts) {
  Zeros zeros;
  zeros.any = std::any_of(parts.begin(), parts.end(), [](const Zeros& part) { return part.any; });
  zeros.all = !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const Zeros& part) { return part.all; });
  zeros.parts = std::make_shared<const std::vector<Zeros>>(std::move(parts));
  return zeros;
}

Zeros constructed_zeros(const GlslType& type, const std::vector<std::pair<GlslType, Zeros>>& operands) {
  if (type.array_dimensions > 0 || type.base == GlslType::Base::structure) {
    std::vector<Zeros> parts;
    for (const auto& operand : operands) parts.push_back(operand.second);
    return composed_zeros(std::move(parts));
  }
  std::vector<Zeros> scalars;
  for (const auto& [operand, zeros] : operands) append_scalars(zeros, operand.columns * operand.rows, scalars);
  const bool one_scalar = operands.size() == 1 && scalars.size() == 1;
  if (one_scalar && !type.is_matrix()) scalars.resize(std::size_t(type.rows), Zeros(scalars[0]));
  if (operands.size() == 1 && type.is_matrix() && (one_scalar || operands[0].first.is_matrix())) {
    // what is not given is that of the unit matrix
    const GlslType& given = operands[0].first;
    scalars.resize(std::size_t(given.columns * given.rows));
    std::vector<Zeros> filled;
    for (int column = 0; column < type.columns; ++column)
      for (int row = 0; row < type.rows; ++row) {
        if (one_scalar)
          filled.push_back(column == row ? scalars[0] : scalar_zeros(true));
        else if (column < given.columns && row < given.rows)
          filled.push_back(scalars[std::size_t(column * given.rows + row)]);
        else
          filled.push_back(scalar_zeros(column != row));
      }
    scalars = std::move(filled);
  }
  scalars.resize(std::size_t(type.columns * type.rows));
  if (type.is_matrix()) {
    std::vector<Zeros> columns;
    for (int column = 0; column < type.columns; ++column) columns.push_back(column_zeros(scalars, column, type.rows));
    return composed_zeros(std::move(columns));
  }
  return type.rows == 1 ? scalars[0] : composed_zeros(std::move(scalars));
}

Zeros part_zeros(const Zeros& whole, std::optional<long> index) {
  if (!whole.parts) return whole.all ? whole : Zeros{};  // .x of a scalar
  if (!index) return whole.all ? whole.parts->front() : Zeros{};
  const bool inside = *index >= 0 && std::size_t(*index) < whole.parts->size();
  return inside ? (*whole.parts)[std::size_t(*index)] : Zeros{};
}

Zeros with_part(const Zeros& whole, std::size_t count, std::optional<long> index, const Zeros& part) {
  constexpr std::size_t kMostParts = 256;  // what is stored into longer arrays is forgotten
  if (!index || *index < 0) return {};
  count = std::max(count, whole.parts ? whole.parts->size() : 0);
  if (count > kMostParts) return {};
  std::vector<Zeros> parts;
  if (whole.parts) parts = *whole.parts;
  parts.resize(count);
  if (std::size_t(*index) >= parts.size()) return {};
  parts[std::size_t(*index)] = part;
  return composed_zeros(std::move(parts));
}

long component_index(char letter) {
  for (const std::string_view letters : {"xyzw", "rgba", "stpq"})
    if (const std::size_t at = letters.find(letter); at != letters.npos) return static_cast<long>(at);
  return 0;
}

}  // namespace twinshade::lint_detail
