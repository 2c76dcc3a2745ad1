#include "base/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/memory.h"
#include "base/removed_on_signal.h"

namespace twinshade {
namespace {
namespace fs = std::filesystem;

constexpr std::uint64_t kMostWithoutSize = std::uint64_t{256} << 20;
constexpr std::uint64_t kLarge = std::uint64_t{64} << 20;  // what is below finds memory enough: not asked for
constexpr int kMostLinks = 40;                             // as Linux

[[noreturn]] void refuse_writing(const std::string& path, const std::string& reason) {
  throw UserError(path + ": cannot be written: " + reason);
}

std::string size_text(std::uint64_t bytes) {
  const bool whole = bytes > 0 && bytes % (1 << 20) == 0;
  return whole ? std::to_string(bytes >> 20) + " MiB" : std::to_string(bytes) + " bytes";
}

// Bytes that a regular file says it has; 0 for all else.
std::uint64_t stated_size(const std::string& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return 0;
  const std::uintmax_t size = fs::file_size(path, code);
  return code ? 0 : size;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

// Where what is written to a path goes.
struct Destination {
  fs::path file;          // links followed
  bool in_place = false;  // a device, a pipe: another file in its place would not be what was named
  int descriptor = -1;    // of this process: what is written goes to where it stands, as with /dev/stdout
};

// N of /proc/self/fd/N; -1 for other paths.
int own_descriptor(const fs::path& link) {
  std::error_code code;
  const std::string name = link.filename().string();
  if (name.empty() || name.size() > 6 || name.find_first_not_of("0123456789") != std::string::npos) return -1;
  const fs::path folder = fs::canonical(folder_of(link), code);
  return !code && folder == fs::canonical("/proc/self/fd", code) ? std::stoi(name) : -1;
}

Destination destination_of(const std::string& path) {
  Destination to;
  to.file = path;
  std::error_code code;
  for (int links = 0; fs::is_symlink(fs::symlink_status(to.file, code)); ++links) {
    to.descriptor = own_descriptor(to.file);
    to.in_place = to.descriptor >= 0;
    if (to.in_place) return to;
    if (links == kMostLinks) refuse_writing(path, std::strerror(ELOOP));
    const fs::path next = fs::read_symlink(to.file, code);
    if (code) refuse_writing(path, code.message());
    to.file = folder_of(to.file) / next;
  }
  const fs::file_status status = fs::status(to.file, code);
  to.in_place = fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  return to;
}

void require_writable(const std::string& path, const Destination& to) {
  if (to.descriptor >= 0) return;
  if (to.in_place) {
    if (::faccessat(AT_FDCWD, to.file.c_str(), W_OK, AT_EACCESS) != 0) refuse_writing(path, std::strerror(errno));
    return;
  }
  const fs::path folder = folder_of(to.file);
  std::error_code code;
  if (!fs::is_directory(folder, code)) refuse_writing(path, "the folder " + folder.string() + " does not exist");
  if (fs::is_directory(to.file, code)) refuse_writing(path, "it is a folder");
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    refuse_writing(path, folder.string() + ": " + std::strerror(errno));
}

void write_in_place(const std::string& path, const Destination& to, std::string_view content) {
  const bool opens = to.descriptor < 0;
  const int descriptor = opens ? ::open(to.file.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC) : to.descriptor;
  if (descriptor < 0) refuse_writing(path, std::strerror(errno));
  int error = 0;
  while (!content.empty() && error == 0) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count >= 0)
      content.remove_prefix(std::size_t(count));
    else if (errno != EINTR)
      error = errno;
  }
  if (opens) ::close(descriptor);
  if (error != 0) refuse_writing(path, std::strerror(error));
}

// Of no other process, here or elsewhere: those in two containers, or on two machines, that write into one folder have
// the same numbers.
const std::string& process_mark() {
  static const std::string mark = [] {
    std::random_device random;
    char text[17];
    std::snprintf(text, sizeof text, "%08x%08x", random(), random());
    return std::string(text);
  }();
  return mark;
}

// Beside the file that it becomes; with its ending, which some libraries go by.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> serial{0};
  return ".twinshade-" + std::to_string(::getpid()) + "-" + process_mark() + "-" + std::to_string(serial++) +
         fs::path(path).extension().string();
}

fs::path folder_of_temporaries(const std::string& path) {
  std::error_code code;
  const fs::path folder = fs::temp_directory_path(code);
  if (code) refuse_writing(path, "no folder for temporary files: " + code.message() + "; set TMPDIR");
  return folder;
}

}  // namespace

std::string read_file(const std::string& path, std::optional<std::uint64_t> most) {
  std::error_code code;
  if (fs::is_directory(path, code)) throw UserError(path + ": is a folder; name a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UserError(path + ": cannot be read: " + std::strerror(errno));
  const std::uint64_t size = stated_size(path);
  const std::uint64_t limit = most.value_or(std::max(size, kMostWithoutSize));
  std::string content;
  const auto refuse_more_than_limit = [&](std::uint64_t bytes) {
    if (bytes > limit)
      throw UserError(path + ": has more than " + size_text(limit) +
                      ", the most that is read of such a file: name a smaller one");
  };
  refuse_more_than_limit(size);
  if (size > kLarge) require_memory(size, path, "name a smaller file");
  content.reserve(std::size_t(size));
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0) {
    refuse_more_than_limit(content.size() + std::uint64_t(in.gcount()));
    content.append(block, std::size_t(in.gcount()));
  }
  if (in.bad()) throw UserError(path + ": cannot be read: " + std::strerror(errno));
  return content;
}

void write_file_with(const std::string& path, const std::function<void(const std::string&)>& write) {
  const Destination to = destination_of(path);
  require_writable(path, to);
  const fs::path folder = to.in_place ? folder_of_temporaries(path) : folder_of(to.file);
  const std::string temporary = (folder / temporary_name(path)).string();
  std::error_code code;
  const RemovedOnSignal removed(temporary);
  try {
    write(temporary);
    if (to.in_place) {
      write_in_place(path, to, read_file(temporary));
      fs::remove(temporary, code);
    } else {
      // A file that is replaced keeps who may read and write it, unless its owner may not.
      constexpr fs::perms kOwn = fs::perms::owner_read | fs::perms::owner_write;
      const fs::file_status replaced = fs::status(to.file, code);
      if (fs::is_regular_file(replaced) && (replaced.permissions() & kOwn) == kOwn)
        fs::permissions(temporary, replaced.permissions() & fs::perms::all, code);
      fs::rename(temporary, to.file, code);
      if (code) refuse_writing(path, code.message());
    }
  } catch (...) {
    fs::remove(temporary, code);
    throw;
  }
}

void write_file(const std::string& path, std::string_view content) {
  if (const Destination to = destination_of(path); to.in_place) {
    write_in_place(path, to, content);
    return;
  }
  write_file_with(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    if (!out) refuse_writing(path, std::strerror(errno));
    out.write(content.data(), std::streamsize(content.size()));
    out.close();
    if (!out) refuse_writing(path, std::strerror(errno));
  });
}

bool is_replaced_by_writing(const std::string& path) { return !destination_of(path).in_place; }

void require_writable_file(const std::string& path) { require_writable(path, destination_of(path)); }

}  // namespace twinshade
