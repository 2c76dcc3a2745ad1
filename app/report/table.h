// Results as aligned columns.
#pragma once

#include <string>
#include <vector>

namespace twinshade {

class Table {
 public:
  enum class Align { left, right };
  // width: at least, for rows that are written before all are known.
  void column(std::string heading, Align align = Align::left, std::size_t width = 0);
  // One cell a column; missing cells at the end are empty.
  void row(std::vector<std::string> cells);
  // The headings, and a row that is not kept, as text() would have them; wider cells move what is behind them.
  std::string headings() const { return line(headings_, widths_); }
  std::string line(const std::vector<std::string>& cells) const { return line(cells, widths_); }
  // Two spaces between columns, no trailing blanks, every line ended.
  std::string text() const;
  bool empty() const { return rows_.empty(); }

 private:
  std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) const;

  std::vector<std::string> headings_;
  std::vector<Align> aligns_;
  std::vector<std::size_t> widths_;  // at least
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace twinshade
