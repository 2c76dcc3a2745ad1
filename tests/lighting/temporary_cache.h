// A folder for cached bakes that is gone with the object.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

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

  // Puts a pipe in the place of every entry, or a link that leads to itself.
  void replace(bool by_pipes) const {
    std::vector<std::filesystem::path> entries;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) entries.push_back(entry.path());
    for (const std::filesystem::path& entry : entries) {
      std::filesystem::remove(entry);
      if (by_pipes)
        ::mkfifo(entry.c_str(), 0600);
      else
        std::filesystem::create_symlink(entry.filename(), entry);
    }
  }
};

}  // namespace twinshade
