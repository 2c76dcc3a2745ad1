#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "experiments/experiment.h"

namespace twinshade {
namespace {

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted.push_back('"');
  return quoted;
}

std::string csv_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_text(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return fmt::format("{:.17g}", *real);
  return "";
}

}  // namespace

Cell number_cell(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }

void Rows::add(std::vector<Cell> cells) {
  TWINSHADE_CHECK_EQ(cells.size(), columns_.size());
  rows_.push_back(std::move(cells));
}

const Cell& Rows::at(std::size_t row, std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  TWINSHADE_CHECK_LT(std::size_t(found - columns_.begin()), columns_.size());
  return rows_.at(row)[std::size_t(found - columns_.begin())];
}

double Rows::number(std::size_t row, std::string_view column) const {
  const Cell& cell = at(row, column);
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return double(*whole);
  return std::numeric_limits<double>::quiet_NaN();
}

std::string Rows::csv() const {
  std::string text;
  const auto line = [&](const auto& cells, auto&& cell_text) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c > 0) text += ',';
      text += cell_text(cells[c]);
    }
    text += '\n';
  };
  line(columns_, csv_text);
  for (const auto& row : rows_) line(row, csv_cell);
  return text;
}

}  // namespace twinshade
