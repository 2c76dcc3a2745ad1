// Results as aligned columns.
#pragma once

#include <string>
#include <vector>

namespace twinshade {

class Table {
 public:
  enum class Align { left, right };
  void column(std::string heading, Align align = Align::left);
  // One cell a column; missing cells at the end are empty.
  void row(std::vector<std::string> cells);
  // Two spaces between columns, no trailing blanks, every line ended.
  std::string text() const;
  bool empty() const { return rows_.empty(); }

 private:
  std::vector<std::string> headings_;
  std::vector<Align> aligns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace twinshade
