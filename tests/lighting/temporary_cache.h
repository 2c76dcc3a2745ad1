// A folder for cached bakes that is gone with the object.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/file.h"

namespace twinshade {

struct TemporaryCache {
  std::string folder;
  TemporaryCache() {
    folder = std::filesystem::temp_directory_path() / ("twinshade_bake_test_" + std::to_string(getpid()));
    setenv("TWINSHADE_CACHE", folder.c_str(), 1);
  }
  ~TemporaryCache() {
    unsetenv("TWINSHADE_CACHE");
    std::filesystem::remove_all(folder);
  }
  TemporaryCache(const TemporaryCache&) = delete;
  TemporaryCache& operator=(const TemporaryCache&) = delete;

  // Flips a bit in the middle of every entry.
  void damage() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      std::string bytes = read_file(entry.path());
      bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
      write_file(entry.path(), bytes);
    }
  }
};

}  // namespace twinshade
