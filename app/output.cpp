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

namespace twinshade {
namespace fs = std::filesystem;

namespace {

void write_to_stdout(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw UserError(std::string("stdout: cannot be written: ") + std::strerror(errno));
}

// A file's path, or - for stdout; empty: not asked for.
void write_to(const std::string& file, const std::string& text) {
  if (file == "-")
    write_to_stdout(text);
  else if (!file.empty())
    write_file(file, text);
}

}  // namespace

Output::Output(const CommonOptions& options, const std::string& junit_file)
    : options_(options), junit_file_(junit_file) {
  if (options.json == "-" && junit_file == "-")
    throw UserError("--json - and --junit -: both go to stdout; name a file for one of them");
  for (const std::string& file : {options.json, junit_file})
    if (!file.empty() && file != "-") require_writable_file(file);
  shows_progress_ = !options.quiet && ::isatty(STDERR_FILENO);
}

void Output::text(const std::string& text) const {
  clear_progress();
  if (options_.json == "-" || junit_file_ == "-")
    std::fputs(text.c_str(), stderr);
  else
    write_to_stdout(text);
}

void Output::note(const std::string& line) const {
  clear_progress();
  if (!options_.quiet) std::fprintf(stderr, "note: %s\n", line.c_str());
}

void Output::progress(const std::string& line) const {
  if (!shows_progress_) return;
  clear_progress();
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  progress_shown_ = true;
}

void Output::clear_progress() const {
  if (progress_shown_) std::fputs("\r\033[K", stderr);  // ECMA-48: erase to the end of the line
  progress_shown_ = false;
}

void Output::json(const Json& json) const {
  if (!options_.json.empty()) write_to(options_.json, json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

void Output::junit(const std::string& xml) const { write_to(junit_file_, xml); }

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
