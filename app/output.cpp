#include "app/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"

namespace twinshade {
namespace fs = std::filesystem;

Output::Output(const CommonOptions& options) : options_(options) {
  if (!options.json.empty() && options.json != "-") require_writable_file(options.json);
  shows_progress_ = !options.quiet && ::isatty(STDERR_FILENO);
}

void Output::text(const std::string& text) const {
  clear_progress();
  std::FILE* stream = options_.json == "-" ? stderr : stdout;
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

void Output::note(const std::string& line) const {
  clear_progress();
  if (!options_.quiet) fmt::print(stderr, "note: {}\n", line);
}

void Output::progress(const std::string& line) const {
  if (!shows_progress_) return;
  clear_progress();
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
  progress_shown_ = true;
}

void Output::clear_progress() const {
  if (progress_shown_) fmt::print(stderr, "\r\033[K");  // ECMA-48: erase to the end of the line
  progress_shown_ = false;
}

void Output::json(const Json& json) const {
  if (options_.json.empty()) return;
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  if (options_.json != "-") {
    write_file(options_.json, text);
  } else if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw UserError(std::string("stdout: cannot be written: ") + std::strerror(errno));
  }
}

void require_writable_file(const std::string& path) {
  const fs::path target(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code code;
  if (!fs::is_directory(folder, code))
    throw UserError(path + ": cannot be written: the folder " + folder.string() + " does not exist");
  if (fs::is_directory(target, code)) throw UserError(path + ": cannot be written: it is a folder");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw UserError(path + ": cannot be written: " + folder.string() + ": " + std::strerror(errno));
}

void require_writable_folder(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw UserError(folder + ": cannot be created: " + code.message());
  if (!fs::is_directory(folder, code)) throw UserError(folder + ": is not a folder");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw UserError(folder + ": cannot be written to: " + std::strerror(errno));
}

std::string hex_float(float value) {
  if (std::isnan(value)) return fmt::format("nan(0x{:08x})", std::bit_cast<std::uint32_t>(value));
  return fmt::format("{:a}", value);
}

}  // namespace twinshade
