// What a scene says about how it was read.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "scenes/scene.h"

namespace twinshade::test {

inline bool has_note(const Scene& scene, const std::string& part) {
  for (const std::string& note : scene.notes)
    if (note.find(part) != std::string::npos) return true;
  return false;
}

// Of the files that it was read from, without their folders.
inline std::set<std::string> file_names(const Scene& scene) {
  std::set<std::string> names;
  for (const std::string& file : scene.files) names.insert(std::filesystem::path(file).filename().string());
  return names;
}

}  // namespace twinshade::test
