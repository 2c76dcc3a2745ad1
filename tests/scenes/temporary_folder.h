// A folder for the files of one test, removed at its end.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"

struct TemporaryFolder {
  std::filesystem::path path;
  TemporaryFolder() {
    static int serial = 0;
    path = std::filesystem::temp_directory_path() /
           ("twinshade_scenes_test_" + std::to_string(::getpid()) + "_" + std::to_string(serial++));
    std::filesystem::create_directories(path);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string write(const std::string& name, std::string_view bytes) const {
    const std::string file = (path / name).string();
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    return file;
  }
  std::string name(const std::string& file) const { return (path / file).string(); }
};

// What `call` complains of; empty if it does not.
template <class Call>
std::string user_error(Call call) {
  try {
    call();
  } catch (const twinshade::UserError& error) {
    return error.what();
  }
  return "";
}
