#include "cpu_shaders/translate/writer.h"

namespace twinshade::spirv {
namespace {

constexpr std::size_t kColumns = 120;

// Where to break a text that must not be longer than `most`: at the last space of those inside the fewest brackets. Any
// space will do, since generated code has spaces nowhere else but between tokens.
std::size_t break_before(const std::string& text, std::size_t most) {
  std::size_t best = std::string::npos;
  int depth = 0, best_depth = 0;
  for (std::size_t k = 0; k < text.size() && k <= most; ++k) {
    const char c = text[k];
    // Operators < and > have spaces around them, template arguments do not.
    const bool after_space = k > 0 && text[k - 1] == ' ';
    if (c == '(' || c == '{' || c == '[' || (c == '<' && !after_space)) ++depth;
    if (c == ')' || c == '}' || c == ']' || (c == '>' && !after_space)) --depth;
    // The first third of a line is too little to break after, unless there is nothing else.
    const bool early = k < most / 3;
    if (c == ' ' && k > 0 && text[k - 1] != '<' &&
        (best == std::string::npos || depth <= best_depth + (best < most / 3 ? 99 : 0)) &&
        (!early || best == std::string::npos || best < most / 3)) {
      best = k;
      best_depth = depth;
    }
  }
  return best;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

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
    const std::size_t space = break_before(rest, kColumns - prefix.size());
    if (space == std::string::npos) break;
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
