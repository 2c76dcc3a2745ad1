#include "app/output.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "app/standard_output.h"
#include "base/error.h"
#include "base/utf8.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {
namespace fs = std::filesystem;

namespace {

// Whether two paths are one regular file, or would be if it were there. What is written to a device destroys nothing.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code code;
  if (fs::exists(a, code) && !fs::is_regular_file(a, code)) return false;
  if (fs::equivalent(a, b, code)) return true;
  const fs::path x = fs::weakly_canonical(fs::absolute(a, code), code);
  return !code && x == fs::weakly_canonical(fs::absolute(b, code), code);
}

// Also of a file that the shell sends stdout to.
bool leads_to_stdout(const std::string& path) {
  struct stat named, standard;
  return ::stat(path.c_str(), &named) == 0 && ::fstat(STDOUT_FILENO, &standard) == 0 && !S_ISCHR(named.st_mode) &&
         named.st_dev == standard.st_dev && named.st_ino == standard.st_ino;
}

}  // namespace

Output::Output(const CommonOptions& options, const ReportOptions& reports, const std::string& folder)
    : options_(options),
      documents_{{{"--json", options.json}, {"--junit", reports.junit}, {"--html", reports.html}}},
      folder_(folder) {
  for (auto one = documents_.begin(); one != documents_.end(); ++one)
    for (auto other = documents_.begin(); other != one; ++other) {
      if (one->file.empty() || other->file.empty()) continue;
      if (one->file == "-" && other->file == "-")
        throw UserError(
            fmt::format("{} - and {} -: both go to stdout; name a file for one of them", other->option, one->option));
      if (one->file != "-" && other->file != "-" && same_file(one->file, other->file))
        throw UserError(fmt::format("{} and {} both write {}: name another file for one of them", other->option,
                                    one->option, one->file));
    }
  std::error_code code;
  for (const Document& document : documents_)
    if (!document.file.empty() && document.file != "-" && (fs::exists(folder, code) || !is_in_folder(document.file)))
      require_writable_file(document.file);
  shows_progress_ = !options.quiet && ::isatty(STDERR_FILENO);
}

std::vector<std::pair<std::string, std::string>> Output::files() const {
  std::vector<std::pair<std::string, std::string>> files;
  for (const Document& document : documents_)
    if (!document.file.empty() && document.file != "-")
      files.emplace_back(std::string(document.option) + " " + document.file, document.file);
  return files;
}

bool Output::document_on_stdout() const {
  return std::any_of(documents_.begin(), documents_.end(), [](const Document& one) { return one.file == "-"; });
}

ResultsInFiles Output::results_in_files() const {
  return files().empty() && folder_.empty() ? ResultsInFiles::none : ResultsInFiles::some;
}

void Output::claim(std::vector<std::string> names) {
  claimed_.insert(std::make_move_iterator(names.begin()), std::make_move_iterator(names.end()));
  for (const std::string& name : claimed_) {
    std::error_code missing;
    const std::string path = claimed(name);
    if (fs::is_symlink(fs::symlink_status(path, missing))) links_.push_back(path);
  }
  for (const auto& [option, file] : files())
    if (claims(file)) throw UserError(option + ": -o " + folder_ + " writes it: name another file for one of them");
}

std::string Output::claimed(const std::string& name) const {
  TWINSHADE_CHECK_EQ(claimed_.count(name), std::size_t{1});
  return (fs::path(folder_) / name).string();
}

bool Output::claims(const std::string& file) const {
  if (claimed_.empty()) return false;
  std::error_code code;
  if (fs::exists(file, code) && !fs::is_regular_file(file, code)) return false;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(file, code), code);
  if (!code && claimed_.contains(resolved.filename().string()) && is_in_folder(file)) return true;
  return std::any_of(links_.begin(), links_.end(), [&](const std::string& link) { return same_file(file, link); });
}

bool Output::is_in_folder(const std::string& file) const {
  if (folder_.empty()) return false;
  std::error_code code;
  const fs::path parent = fs::weakly_canonical(fs::absolute(file, code), code).parent_path();
  fs::path folder = fs::weakly_canonical(fs::absolute(folder_, code), code);
  if (!folder.has_filename()) folder = folder.parent_path();  // "out/"
  return !code && parent == folder;
}

void Output::write_to(const std::string& file, const std::string& text) const {
  if (file == "-") {
    write_to_stdout(text, results_in_files());
  } else if (!file.empty()) {
    if (is_in_folder(file)) make_folder(folder_);
    write_file(file, text);
  }
}

void Output::require_not_read(const std::vector<std::string>& read, const std::string& written) const {
  auto all = files();
  if (!written.empty()) {
    for (const auto& [option, file] : all)
      if (same_file(file, written)) throw UserError(option + ": -o writes it: name another file for one of them");
    all.emplace_back("-o " + written, written);
  }
  for (const auto& [option, file] : all)
    for (const std::string& input : read)
      if (same_file(file, input))
        throw UserError(option + ": it would replace " + input + ", which is read: name another file");
  for (const std::string& input : read)
    if (claims(input))
      throw UserError("-o " + folder_ + ": it would replace " + input + ", which is read: name another folder");
}

void Output::leave_stdout_to(const std::string& file) {
  stdout_left_ = leads_to_stdout(file);
  for (const Document& document : documents_)
    if (stdout_left_ && document.file == "-")
      throw UserError(
          fmt::format("{} -: -o {} goes to stdout, too; name a file for one of them", document.option, file));
}

void Output::require_not_taken(const std::string& folder, const std::string& ending, const std::string& what) const {
  for (const auto& [option, file] : files()) {
    std::error_code code;
    const fs::path parent = fs::path(file).parent_path();
    if (fs::path(file).extension() == ending && fs::equivalent(parent.empty() ? "." : parent, folder, code))
      throw UserError(option + ": in " + folder + " it would be taken for " + what + ": name a file in another folder");
  }
}

void Output::text(const std::string& text) const {
  clear_progress();
  if (document_on_stdout() || stdout_left_)
    std::fputs(text.c_str(), stderr);
  else
    write_to_stdout(text, results_in_files());
}

void Output::note(const std::string& line) const {
  if (options_.quiet || !noted_.insert(line).second) return;
  clear_progress();
  std::fprintf(stderr, "note: %s\n", one_line(line).c_str());
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

void Output::json_so_far(const Json& so_far) const {
  if (!options_.json.empty() && options_.json != "-" && is_replaced_by_writing(options_.json)) json(so_far);
}

void Output::junit(const std::string& xml) const { write_to(documents_[kJUnit].file, xml); }

void Output::html(const std::string& page) const { write_to(documents_[kHtml].file, page); }

std::vector<std::string> files_of_shader(const std::string& shader, const SourceOptions& options) {
  std::vector<std::string> files{shader};
  std::error_code code;
  if (!fs::is_regular_file(shader, code)) return files;
  try {
    const ShaderSource source = load_fragment_shader(shader, options);
    files.insert(files.end(), source.files.begin(), source.files.end());
  } catch (const std::exception&) {  // told where it is read to be run
  }
  return files;
}

void require_writable_folder(const std::string& folder) {
  std::error_code code;
  fs::path there = folder;  // as far as it is there: the rest would be made in that
  fs::file_status status = fs::symlink_status(there, code);
  for (; status.type() == fs::file_type::not_found && there != "."; status = fs::symlink_status(there, code))
    there = there.has_parent_path() ? there.parent_path() : fs::path(".");
  if (status.type() == fs::file_type::none) throw UserError(folder + ": cannot be created: " + code.message());
  const bool whole = there == fs::path(folder);
  const std::string trouble = folder + (whole ? ": " : ": cannot be created: " + there.string() + " ");
  if (!fs::is_directory(there, code)) throw UserError(trouble + "is not a folder");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw UserError(trouble + "cannot be written to: " + std::strerror(errno));
}

void make_folder(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw UserError(folder + ": cannot be created: " + code.message());
}

Json ulp_json(std::uint64_t ulp) { return ulp == UINT64_MAX ? Json(nullptr) : Json(ulp); }

std::string hex_float(float value) {
  if (std::isnan(value)) return fmt::format("nan(0x{:08x})", std::bit_cast<std::uint32_t>(value));
  return fmt::format("{:a}", value);
}

}  // namespace twinshade
