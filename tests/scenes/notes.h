// What a scene says about how it was read.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace twinshade::test {

inline bool has_note(const Scene& scene, const std::string& part) {
  for (const std::string& note : scene.notes)
    if (note.find(part) != std::string::npos) return true;
  return false;
}

}  // namespace twinshade::test
