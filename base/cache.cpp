#include "base/cache.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"

namespace twinshade {
namespace {
namespace fs = std::filesystem;
using Clock = fs::file_time_type::clock;

constexpr std::chrono::minutes kInUse{1};
constexpr std::chrono::minutes kCompiling{30};  // runtime-*: two compilations, as long as each may take, read from it
constexpr std::chrono::hours kAbandoned{1};     // temporaries of a process that was killed
constexpr std::uint64_t kDefaultLimit = std::uint64_t{2} << 30;

struct Entry {
  fs::path path;
  fs::file_time_type used;
  std::uint64_t size;
};

std::uint64_t size_of(const fs::path& path) {
  std::error_code code;
  if (!fs::is_directory(path, code)) {
    const auto size = fs::file_size(path, code);
    return code ? 0 : size;
  }
  std::uint64_t size = 0;
  for (auto inside = fs::recursive_directory_iterator(path, code); !code && inside != fs::end(inside);
       inside.increment(code))
    if (std::error_code ignored; inside->is_regular_file(ignored)) size += inside->file_size(ignored);
  return size;
}

bool is_temporary(const std::string& name) { return name.starts_with(".twinshade-"); }

// Strict, since entries get removed: the folder may be shared with files of the user's.
bool is_entry(const std::string& name) {
  for (const std::string_view kind : {"bake-", "runtime-", "shader-"}) {
    if (!name.starts_with(kind)) continue;
    const std::size_t end = name.find_first_not_of("0123456789abcdef", kind.size());
    return std::min(end, name.size()) - kind.size() >= 16;
  }
  return false;
}

std::chrono::minutes use_time(const Entry& entry) {
  return entry.path.filename().string().starts_with("runtime-") ? kCompiling : kInUse;
}

bool is_abandoned(const std::string& name, fs::file_time_type::duration age) {
  return is_temporary(name) && age > kAbandoned;
}

// What is within a folder of the cache: a compiler that was killed leaves half an object there.
void remove_abandoned_in(const fs::path& folder) {
  const auto now = Clock::now();
  std::vector<fs::path> abandoned;
  std::error_code code;
  for (auto at = fs::recursive_directory_iterator(folder, code); !code && at != fs::end(at); at.increment(code)) {
    std::error_code gone;
    const auto written = at->last_write_time(gone);
    if (!gone && is_abandoned(at->path().filename().string(), now - written)) abandoned.push_back(at->path());
  }
  for (const fs::path& path : abandoned) fs::remove_all(path, code);
}

// Other processes add and remove meanwhile: what has gone is skipped. Abandoned temporaries within entries go at once.
std::vector<Entry> list_entries(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code code;
  for (auto at = fs::directory_iterator(folder, code); !code && at != fs::end(at); at.increment(code)) {
    const std::string name = at->path().filename().string();
    if (!is_entry(name) && !is_temporary(name)) continue;
    std::error_code gone;
    const auto used = fs::last_write_time(at->path(), gone);
    if (is_entry(name)) remove_abandoned_in(at->path());
    if (!gone) entries.push_back({at->path(), used, size_of(at->path())});
  }
  return entries;
}

[[noreturn]] void refuse_cache(const fs::path& folder, const std::string& reason) {
  throw UserError(folder.string() + ": the cache cannot be written: " + reason +
                  "; set TWINSHADE_CACHE to a folder of your own");
}

void clear_way(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::symlink_status(path, code);
  if (fs::exists(status) && !fs::is_regular_file(status)) fs::remove_all(path, code);
}

}  // namespace

std::string cache_folder() {
  cache_size_limit();  // a size that is no size is an error before minutes of work, not after
  fs::path folder;
  if (const char* own = std::getenv("TWINSHADE_CACHE"); own && *own)
    folder = own;
  else if (const char* xdg = std::getenv("XDG_CACHE_HOME");
           xdg && *xdg == '/')  // its specification: others are ignored
    folder = fs::path(xdg) / "twinshade";
  else if (const char* home = std::getenv("HOME"); home && *home)
    folder = fs::path(home) / ".cache" / "twinshade";
  else
    throw UserError("no cache folder: set HOME, XDG_CACHE_HOME or TWINSHADE_CACHE");
  // Compilers take such a path for an option, or for a file of options.
  if (const char first = folder.native()[0]; first == '-' || first == '@') folder = "." / folder;
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw UserError(folder.string() + ": cannot be created: " + code.message() + "; set TWINSHADE_CACHE");
  return folder.string();
}

void require_writable_cache() {
  const std::string folder = cache_folder();
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) refuse_cache(folder, std::strerror(errno));
}

std::string make_cache_folder(const std::string& name) {
  fs::path folder = cache_folder();
  for (const fs::path& part : fs::path(name)) {
    folder /= part;
    std::error_code code;
    if (fs::is_directory(folder, code)) continue;
    // Another process may be making it: what became a folder meanwhile is not unlinked.
    ::unlink(folder.c_str());
    fs::create_directory(folder, code);
    if (code) refuse_cache(folder, code.message());
  }
  return folder.string();
}

void write_cached(const std::string& path, std::string_view content) {
  clear_way(path);
  write_file(path, content);
}

void write_cached_with(const std::string& path, const std::function<void(const std::string&)>& write) {
  clear_way(path);
  write_file_with(path, write);
}

std::uint64_t cache_size_limit() {
  const char* text = std::getenv("TWINSHADE_CACHE_SIZE");
  if (!text || !*text) return kDefaultLimit;
  const std::string_view given(text);
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), count);
  const std::string_view rest = given.substr(std::size_t(end - given.data()));
  constexpr std::string_view kUnits = "KMGT";
  std::size_t unit = std::string_view::npos;
  if (rest.size() == 1) unit = kUnits.find(char(std::toupper(static_cast<unsigned char>(rest[0]))));
  const bool wrong_unit = !rest.empty() && unit == std::string_view::npos;
  const int shift = rest.empty() || wrong_unit ? 0 : 10 * int(unit + 1);
  if (error != std::errc() || wrong_unit || count > std::numeric_limits<std::uint64_t>::max() >> shift)
    throw UserError("TWINSHADE_CACHE_SIZE=" + std::string(given) +
                    ": not a size; give bytes or a number with K, M, G or T, as 500M");
  return count << shift;
}

void touch_cached(const std::string& path) {
  std::error_code ignored;  // a cache that can only be read has no ages
  fs::last_write_time(path, Clock::now(), ignored);
}

void trim_cache() {
  const std::uint64_t limit = cache_size_limit();
  std::vector<Entry> entries = list_entries(cache_folder());
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.used != b.used ? a.used < b.used : a.path < b.path; });
  std::uint64_t total = 0;
  for (const Entry& entry : entries) total += entry.size;
  const auto now = Clock::now();
  for (const Entry& entry : entries) {
    const auto age = now - entry.used;
    const bool abandoned = is_abandoned(entry.path.filename().string(), age);
    if (!abandoned && (total <= limit || age < use_time(entry))) continue;
    std::error_code ignored;
    fs::remove_all(entry.path, ignored);
    total -= entry.size;
  }
}

void seal(const std::string& path) {
  const std::string hash = sha256_hex(read_file(path));
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out << hash;
  out.close();
  if (!out) throw UserError(path + ": cannot be written");
}

bool is_sealed(const std::string& path) {
  constexpr std::size_t kHashLength = 64;
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return false;
  std::string content;
  try {
    content = read_file(path);
  } catch (const UserError&) {
    return false;
  }
  if (content.size() < kHashLength) return false;
  const std::string_view sealed(content.data(), content.size() - kHashLength);
  return sha256_hex(sealed) == std::string_view(content).substr(sealed.size());
}

}  // namespace twinshade
