#include "app/report/table.h"

#include <algorithm>

#include "base/error.h"

namespace twinshade {
namespace {

// Characters of UTF-8: names of files are not ASCII alone.
std::size_t width_of(const std::string& cell) {
  return std::size_t(std::count_if(cell.begin(), cell.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

void Table::column(std::string heading, Align align, std::size_t width) {
  widths_.push_back(std::max(width, width_of(heading)));
  headings_.push_back(std::move(heading));
  aligns_.push_back(align);
}

void Table::row(std::vector<std::string> cells) {
  TWINSHADE_CHECK_LE(cells.size(), headings_.size());
  cells.resize(headings_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) const {
  TWINSHADE_CHECK_LE(cells.size(), widths.size());
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string padding(std::max(widths[c], width_of(cells[c])) - width_of(cells[c]), ' ');
    if (c > 0) line += "  ";
    line += aligns_[c] == Align::left ? cells[c] + padding : padding + cells[c];
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

std::string Table::text() const {
  std::vector<std::size_t> widths = widths_;
  for (const auto& cells : rows_)
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], width_of(cells[c]));
  std::string text = line(headings_, widths);
  for (const auto& cells : rows_) text += line(cells, widths);
  return text;
}

}  // namespace twinshade
