#include "app/report/case_result.h"

#include <regex>

namespace twinshade {

std::pair<std::string, int> place_of(const CaseResult& c) {
  std::vector<std::string> known = c.files;
  known.push_back(c.file);
  const std::string* begun = nullptr;
  for (const std::string& file : known)
    if (!file.empty() && c.message.rfind(file + ":", 0) == 0 && (begun == nullptr || begun->size() < file.size()))
      begun = &file;
  std::smatch match;
  if (begun != nullptr) {
    const std::string behind = c.message.substr(begun->size());
    const bool numbered = std::regex_search(behind, match, std::regex("^:([0-9]{1,9}):"));
    return {*begun, numbered ? std::stoi(match[1].str()) : *begun == c.file ? c.line : 0};
  }
  if (!std::regex_search(c.message, match, std::regex("^([^:\\s]+):([0-9]{1,9}):"))) return {c.file, c.line};
  return {match[1].str(), std::stoi(match[2].str())};
}

}  // namespace twinshade
