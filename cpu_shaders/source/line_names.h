// Names of files behind #line: between quotes, which they cannot hold themselves.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace twinshade {

inline std::string line_name(std::string path) {
  std::replace(path.begin(), path.end(), '"', '\'');
  std::replace(path.begin(), path.end(), '\n', ' ');
  return path;
}

// A name that #line gave, or a text that such names stand in, with those of `files` as they are called.
inline std::string with_real_names(const std::vector<std::string>& files, std::string text) {
  for (const std::string& file : files) {
    const std::string name = line_name(file);
    if (name == file || name.empty()) continue;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + file.size()))
      text.replace(at, name.size(), file);
  }
  return text;
}

}  // namespace twinshade
