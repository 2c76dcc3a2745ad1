#include "cpu_shaders/source/vulkan_layouts.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/source/glsl_pieces.h"

namespace twinshade {
namespace {

using Pieces = std::vector<std::string_view>;

struct Qualifier {  // pieces [begin, end), "set", "=" and "1"
  std::size_t begin, end;
};

// Of a layout from its "(" on, whose ")" is at `close`.
std::vector<Qualifier> qualifiers(const Pieces& pieces, std::size_t open, std::size_t close) {
  std::vector<Qualifier> all;
  int depth = 0;
  std::size_t begin = open + 1;
  for (std::size_t i = begin; i <= close; ++i) {
    if (i == close || (depth == 0 && pieces[i] == ",")) {
      if (i > begin) all.push_back({begin, i});
      begin = i + 1;
    } else {
      depth += (pieces[i] == "(") - (pieces[i] == ")");
    }
  }
  return all;
}

std::size_t closing(const Pieces& pieces, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < pieces.size(); ++i) {
    depth += (pieces[i] == "(") - (pieces[i] == ")");
    if (depth == 0) return i;
  }
  return pieces.size();
}

// One `layout(...)`. What goes from it is blanked with the commas that separate nothing any more; if nothing stays, all
// of it.
class Layout {
 public:
  Layout(const Pieces& pieces, std::size_t layout, std::size_t close)
      : pieces_(pieces), layout_(layout), close_(close), all_(qualifiers(pieces, layout + 1, close)) {}

  bool is_of_vulkan() const { return has("set") || has("push_constant"); }

  void rewrite(std::string& text, const char* readable) const {
    const auto write = [&](std::size_t piece, std::string_view what) {
      const std::size_t at = std::size_t(pieces_[piece].data() - readable), size = pieces_[piece].size();
      text.replace(at, size, std::string(what) + std::string(size - what.size(), ' '));
    };
    bool any_stays = false;
    for (const Qualifier& q : all_) {
      if (q.begin > layout_ + 2 && !(any_stays && stays(q))) write(q.begin - 1, "");
      if (!stays(q))
        for (std::size_t i = q.begin; i < q.end; ++i) write(i, "");
      else if (pieces_[q.begin] == "push_constant")
        write(q.begin, "std140");
      any_stays |= stays(q);
    }
    if (!any_stays)
      for (const std::size_t i : {layout_, layout_ + 1, close_}) write(i, "");
  }

 private:
  bool has(std::string_view name) const {
    return std::any_of(all_.begin(), all_.end(), [&](const Qualifier& q) { return pieces_[q.begin] == name; });
  }
  bool stays(const Qualifier& q) const {
    const std::string_view name = pieces_[q.begin];
    if (has("push_constant") && (name == "std430" || name == "std140")) return false;
    return name != "set" && name != "binding";
  }

  const Pieces& pieces_;
  const std::size_t layout_, close_;
  const std::vector<Qualifier> all_;
};

}  // namespace

std::string without_vulkan_layouts(const std::string& text) {
  if (find_word(text, "layout") == text.npos ||
      (find_word(text, "set") == text.npos && find_word(text, "push_constant") == text.npos))
    return text;
  std::string readable = text;  // layouts in macros, too
  std::replace(readable.begin(), readable.end(), '#', ' ');
  const Pieces pieces = pieces_of(readable);
  std::string result = text;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    if (pieces[i] != "layout" || pieces[i + 1] != "(") continue;
    const std::size_t close = closing(pieces, i + 1);
    if (close == pieces.size()) break;
    const Layout layout(pieces, i, close);
    if (layout.is_of_vulkan()) layout.rewrite(result, readable.data());
  }
  return result;
}

}  // namespace twinshade
