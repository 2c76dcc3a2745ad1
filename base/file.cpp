#include "base/file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
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
  std::string content;
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0) content.append(block, std::size_t(in.gcount()));
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

}  // namespace twinshade
