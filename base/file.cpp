#include "base/file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace twinshade {
namespace fs = std::filesystem;

std::string read_file(const std::string& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) throw UserError(path + ": is a folder; name a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UserError(path + ": cannot be read: " + std::strerror(errno));
  std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw UserError(path + ": cannot be read: " + std::strerror(errno));
  return content;
}

void write_file_with(const std::string& path, const std::function<void(const std::string&)>& write) {
  static std::atomic<unsigned> serial{0};
  const fs::path target(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code code;
  if (!fs::is_directory(folder, code))
    throw UserError(path + ": cannot be written: the folder " + folder.string() + " does not exist");
  if (fs::is_directory(target, code)) throw UserError(path + ": cannot be written: it is a folder");
  const std::string temporary = (folder / (".twinshade-" + std::to_string(::getpid()) + "-" + std::to_string(serial++) +
                                           target.extension().string()))
                                    .string();
  try {
    write(temporary);
    fs::rename(temporary, target, code);
    if (code) throw UserError(path + ": cannot be written: " + code.message());
  } catch (...) {
    fs::remove(temporary, code);
    throw;
  }
}

void write_file(const std::string& path, std::string_view content) {
  write_file_with(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    if (!out) throw UserError(path + ": cannot be written: " + std::strerror(errno));
    out.write(content.data(), std::streamsize(content.size()));
    out.close();
    if (!out) throw UserError(path + ": cannot be written: " + std::strerror(errno));
  });
}

std::string cache_folder() {
  fs::path folder;
  if (const char* own = std::getenv("TWINSHADE_CACHE"); own && *own)
    folder = own;
  else if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg)
    folder = fs::path(xdg) / "twinshade";
  else if (const char* home = std::getenv("HOME"); home && *home)
    folder = fs::path(home) / ".cache" / "twinshade";
  else
    throw UserError("no cache folder: set HOME, XDG_CACHE_HOME or TWINSHADE_CACHE");
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw UserError(folder.string() + ": cannot be created: " + code.message() + "; set TWINSHADE_CACHE");
  return folder.string();
}

}  // namespace twinshade
