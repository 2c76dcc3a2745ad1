// Optimal string alignment distance (the restricted edit distance of Damerau and Levenshtein).
#include "base/names.h"

#include <algorithm>

namespace twinshade {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return result;
}

std::string in_quotes(std::string_view name) {
  std::string result = "'";
  for (char c : name) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return result + "'";
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> before(columns), previous(columns), current(columns);
  for (std::size_t j = 0; j < columns; ++j) previous[j] = int(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = int(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substituted = previous[j - 1] + (a[i - 1] != b[j - 1]);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string unknown_name_message(std::string_view kind, std::string_view name,
                                 const std::vector<std::string>& candidates) {
  struct Near {
    int distance;
    const std::string* name;
  };
  const std::string wanted = lower(name);
  std::vector<Near> near;
  for (const std::string& candidate : candidates) {
    const std::string known = lower(candidate);
    const int distance = edit_distance(wanted, known);
    const int allowed = std::max<int>(1, int(std::max(wanted.size(), known.size())) / 3);
    const bool begins = wanted.size() >= 3 && known.compare(0, wanted.size(), wanted) == 0;
    if (distance <= allowed || begins) near.push_back({distance, &candidate});
  }
  std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  if (near.size() > 3) near.resize(3);

  std::string message = "unknown " + std::string(kind) + " " + in_quotes(name);
  if (!near.empty()) {
    message += "; did you mean ";
    for (std::size_t i = 0; i < near.size(); ++i)
      message += (i == 0 ? "" : i + 1 == near.size() ? " or " : ", ") + in_quotes(*near[i].name);
    return message + "?";
  }
  if (candidates.empty()) return message;
  message += "; known: ";
  for (std::size_t i = 0; i < candidates.size(); ++i) message += (i == 0 ? "" : ", ") + candidates[i];
  return message;
}

}  // namespace twinshade
