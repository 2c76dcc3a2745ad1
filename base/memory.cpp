#include "base/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/error.h"

namespace twinshade {
namespace {

// The number behind `name` in a file of lines "name value" or "name: value kB".
std::optional<std::uint64_t> number_in(const std::string& path, const std::string& name) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    std::uint64_t value = 0;
    if (words >> first >> value && (first == name || first == name + ":")) return value;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> number_of(const std::string& path) {
  std::ifstream in(path);
  std::uint64_t value = 0;
  if (in >> value) return value;
  return std::nullopt;  // missing, or "max"
}

std::uint64_t free_of_system() {
  const auto kib = number_in("/proc/meminfo", "MemAvailable");
  return kib ? *kib * 1024 : UINT64_MAX;
}

// Of the process' control group and all above it. Files that were read and are not in use do not count as taken.
std::uint64_t free_of_groups() {
  std::ifstream in("/proc/self/cgroup");
  std::string group;
  for (std::string line; std::getline(in, line);)
    if (line.rfind("0::", 0) == 0) group = line.substr(3);
  std::uint64_t least = UINT64_MAX;
  for (;; group.erase(group.rfind('/'))) {
    const std::string folder = "/sys/fs/cgroup" + (group == "/" ? std::string() : group);
    const auto most = number_of(folder + "/memory.max"), taken = number_of(folder + "/memory.current");
    if (most && taken) {
      const std::uint64_t idle = number_in(folder + "/memory.stat", "inactive_file").value_or(0);
      const std::uint64_t used = *taken - std::min(*taken, idle);
      least = std::min(least, *most - std::min(*most, used));
    }
    if (group.find('/') == std::string::npos) return least;
  }
}

std::uint64_t free_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return UINT64_MAX;
  const std::uint64_t used = number_in("/proc/self/status", "VmSize").value_or(0) * 1024;
  return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used);
}

std::string in_gib(std::uint64_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GiB", double(bytes) / double(1 << 30));
  return text;
}

}  // namespace

std::uint64_t available_memory() { return std::min({free_of_system(), free_of_groups(), free_of_address_space()}); }

void require_memory(std::uint64_t bytes, const std::string& what, const std::string& remedy) {
  const std::uint64_t available = available_memory();
  if (bytes > available)
    throw UserError(what + " needs " + in_gib(bytes) + " of memory, but " + in_gib(available) +
                    " are available: " + remedy);
}

std::uint64_t peak_memory() { return number_in("/proc/self/status", "VmHWM").value_or(0) * 1024; }

void restart_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }  // proc(5)

}  // namespace twinshade
