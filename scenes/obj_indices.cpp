#include "scenes/obj_indices.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"

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
  std::size_t kind = 0;  // of the next index of a corner, as 1/2/3
  for (std::size_t at = 0; at < rest.size();) {
    if (rest[at] == '/' || kBetweenCorners.find(rest[at]) != std::string_view::npos) {
      kind = rest[at] == '/' ? kind + 1 : 0;
      ++at;
      continue;
    }
    std::int64_t index = 0;
    const char* const last = rest.data() + rest.size();
    const auto [behind, error] = std::from_chars(rest.data() + at, last, index);
    if (error != std::errc() || kind >= kKinds) return;
    at = std::size_t(behind - rest.data());
    if (index == 0 || index < -counts_[kind]) refuse(path, line, kind, index, counts_[kind]);
    if (index > largest_[kind].index) largest_[kind] = {index, line};
  }
}

void ObjIndices::check(const std::string& path) const {
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    if (const auto& [index, line] = largest_[kind]; index > counts_[kind])
      refuse(path, line, kind, index, counts_[kind]);
}

}  // namespace twinshade
