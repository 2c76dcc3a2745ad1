#include "scenes/obj_indices.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "scenes/obj_lines.h"

namespace twinshade {
namespace {

constexpr std::string_view kBetweenCorners = " \t\r";
constexpr std::array<std::string_view, 3> kKeywords = {"v", "vt", "vn"};
constexpr std::array<const char*, 3> kNames = {"vertex", "texture coordinate (vt)", "normal (vn)"};

[[noreturn]] void refuse(const std::string& path, std::size_t line, std::size_t kind, std::int64_t index,
                         std::int64_t count) {
  throw UserError(path + ":" + std::to_string(line) + ": " + kNames[kind] + " " + std::to_string(index) +
                  " is not there: " +
                  (index > 0 && count == 0 ? "the file has none"
                                           : "there are " + std::to_string(count) + (index < 0 ? " before it" : "") +
                                                 ", numbered from 1, or from -1 backwards"));
}

}  // namespace

void ObjIndices::read(std::string_view statement, const std::string& path, std::size_t line) {
  const std::size_t end = std::min(statement.find_first_of(kBetweenCorners), statement.size());
  const std::string_view keyword = statement.substr(0, end);
  for (std::size_t kind = 0; kind < kKinds; ++kind) counts_[kind] += keyword == kKeywords[kind];
  if (keyword != "f" && keyword != "l" && keyword != "p") return;

  std::string_view rest = statement.substr(end);
  rest = rest.substr(0, rest.find('#'));
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBetweenCorners), rest.size()));
    if (rest.empty()) break;
    const std::string_view corner = rest.substr(0, rest.find_first_of(kBetweenCorners));
    rest.remove_prefix(corner.size());
    read_corner(corner, path, line);
  }
}

// assimp takes +1 for another vertex, and leaves out what stands behind 1 in 1-3.
void ObjIndices::read_corner(std::string_view corner, const std::string& path, std::size_t line) {
  const char* at = corner.data();
  const char* const last = at + corner.size();
  bool right = true;
  for (std::size_t kind = 0; right; ++kind) {
    std::int64_t index = 0;
    const auto [behind, error] = std::from_chars(at, last, index);
    const bool left_out = kind > 0 && (at == last || *at == '/');
    right = kind < kKinds && (error == std::errc() || left_out);
    if (!right) break;
    if (!left_out) {
      if (index == 0 || index < -counts_[kind]) refuse(path, line, kind, index, counts_[kind]);
      if (index > largest_[kind].index) largest_[kind] = {index, line};
      at = behind;
    }
    if (at == last) return;
    right = *at++ == '/';
  }
  throw UserError(path + ":" + std::to_string(line) + ": '" + shown_word(corner) +
                  "' names no corner: write v, v/vt, v//vn or v/vt/vn, numbers of those lines");
}

void ObjIndices::check(const std::string& path) const {
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    if (const auto& [index, line] = largest_[kind]; index > counts_[kind])
      refuse(path, line, kind, index, counts_[kind]);
}

}  // namespace twinshade
