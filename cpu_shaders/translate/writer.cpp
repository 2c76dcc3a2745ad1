#include "cpu_shaders/translate/writer.h"

namespace twinshade::spirv {
namespace {
constexpr std::size_t kColumns = 120;
}

// Breaks after the last space that follows a comma or precedes an operator: any space does, since generated code has
// spaces nowhere else but between tokens. Comments are never broken.
void Writer::line(const std::string& text) {
  if (text.empty()) {
    lines_.emplace_back();
    return;
  }
  std::string prefix(static_cast<std::size_t>(2 * depth_), ' ');
  std::string rest = text;
  const bool comment = text.rfind("//", 0) == 0;
  bool first = true;
  while (!comment && prefix.size() + rest.size() > kColumns) {
    const std::size_t space = rest.rfind(' ', kColumns - prefix.size());
    if (space == std::string::npos || space == 0) break;
    lines_.push_back(prefix + rest.substr(0, space));
    rest = rest.substr(space + 1);
    if (first) prefix += "    ";
    first = false;
  }
  lines_.push_back(prefix + rest);
}

void Writer::raw(const std::string& text) { lines_.push_back(text); }

std::vector<std::string> Writer::take(std::size_t mark) {
  std::vector<std::string> taken(lines_.begin() + static_cast<std::ptrdiff_t>(mark), lines_.end());
  lines_.resize(mark);
  return taken;
}

std::string Writer::text() const {
  std::string all;
  for (const std::string& l : lines_) all += l + '\n';
  return all;
}

}  // namespace twinshade::spirv
