// Translated C++ to a shared object, cached by content: the key is the C++, the runtime's headers, the compiler and its flags.
// A cached object ends in the SHA-256 of what is before it (loaders ignore the tail), so a damaged one is seen and rebuilt
// instead of loaded. Processes that race build the same thing under different temporary names; the last rename wins.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <sstream>
#include <vector>

#include "base/embedded_file.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "cpu_shaders/load/load.h"

extern char** environ;

namespace twinshade {

std::span<const EmbeddedFile> embedded_runtime();  // made by the build

namespace {
namespace fs = std::filesystem;

constexpr std::size_t kHashLength = 64;

std::vector<std::string> words_of(const char* text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::string find_program(const std::string& name) {
  const auto runs = [](const fs::path& path) {
    std::error_code code;
    return fs::is_regular_file(path, code) && access(path.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) return runs(name) ? name : "";
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path candidate = fs::path(folder) / name; runs(candidate)) return candidate.string();
  return "";
}

// clang++ before g++: as fast code in half the time.
std::string find_compiler(const std::string& asked) {
  std::vector<std::string> names;
  if (!asked.empty()) {
    names = {asked};
  } else {
    if (const char* cxx = std::getenv("CXX"); cxx && *cxx) names.emplace_back(cxx);
    names.insert(names.end(), {"clang++", "g++", "c++"});
  }
  for (const std::string& name : names)
    if (std::string path = find_program(name); !path.empty()) return path;
  throw UserError("no C++ compiler found (tried " + fmt::format("{}", fmt::join(names, ", ")) +
                  "): shaders that are not built in need one; install g++ or clang, or set CXX");
}

// Path, size and time of the compiler stand for its version: asking it would cost more than a cached shader.
std::string identity_of(const std::string& compiler) {
  std::error_code code;
  const fs::path real = fs::canonical(compiler, code);
  if (code) return compiler;
  const auto time = fs::last_write_time(real, code).time_since_epoch().count();
  return fmt::format("{} {} {}", real.string(), fs::file_size(real, code), time);
}

// Runs a program with its output in a file; its exit status.
int run_program(const std::vector<std::string>& words, const std::string& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

const std::string& embedded_runtime_hash() {
  static const std::string hash = [] {
    Sha256 all;
    for (const EmbeddedFile& file : embedded_runtime()) {
      all.add(file.path);
      all.add("\0", 1);
      all.add(file.content);
      all.add("\0", 1);
    }
    return all.hex();
  }();
  return hash;
}

// Headers and sources that compiled shaders need, unpacked once per content.
std::string unpack_runtime(const std::string& cache) {
  const fs::path folder = fs::path(cache) / ("runtime-" + embedded_runtime_hash().substr(0, 16));
  for (const EmbeddedFile& file : embedded_runtime()) {
    const fs::path path = folder / std::string(file.path);
    std::error_code code;
    if (fs::exists(path, code)) {
      if (read_file(path.string()) == file.content) continue;
    }
    fs::create_directories(path.parent_path(), code);
    write_file(path.string(), file.content);
  }
  return folder.string();
}

bool is_whole(const std::string& path) {
  std::error_code code;
  if (!fs::exists(path, code)) return false;
  const std::string content = read_file(path);
  return content.size() > kHashLength &&
         sha256_hex(std::string_view(content).substr(0, content.size() - kHashLength)) ==
             std::string_view(content).substr(content.size() - kHashLength);
}

}  // namespace

std::string compile_shader(const std::string& cpp, Isa isa, Number number, const std::string& asked_compiler) {
  static constexpr std::array<const char*, 3> kIsaNames{"baseline", "avx2", "avx512"};
  static constexpr std::array<const char*, 3> kIsaFlags{TWINSHADE_FLAGS_BASELINE, TWINSHADE_FLAGS_AVX2,
                                                        TWINSHADE_FLAGS_AVX512};
  const std::string compiler = find_compiler(asked_compiler);
  const std::string cache = cache_folder();
  std::vector<std::string> flags = words_of("-std=c++20 -O2 -fPIC -shared -fvisibility=hidden -w " TWINSHADE_FLOAT_FLAGS);
  for (const std::string& word : words_of(kIsaFlags[std::size_t(isa)])) flags.push_back(word);
  flags.push_back(std::string("-DTWINSHADE_ISA=") + kIsaNames[std::size_t(isa)]);
  flags.push_back(fmt::format("-DTWINSHADE_NUMBERS={}", 1 << int(number)));
  flags.emplace_back("-DTWINSHADE_SHARED_OBJECT=1");

  Sha256 hash;
  for (const std::string& part : {cpp, embedded_runtime_hash(), identity_of(compiler), fmt::format("{}", fmt::join(flags, " "))}) {
    hash.add(part);
    hash.add("\0", 1);
  }
  const fs::path folder = fs::path(cache) / "shaders";
  std::error_code code;
  fs::create_directories(folder, code);
  const std::string object = (folder / (hash.hex() + ".so")).string();
  if (is_whole(object)) return object;

  const std::string runtime = unpack_runtime(cache);
  write_file_with(object, [&](const std::string& temporary) {
    const std::string source = temporary + ".cpp", log = temporary + ".log";
    write_file(source, cpp);
    std::vector<std::string> command{compiler};
    command.insert(command.end(), flags.begin(), flags.end());
    for (const std::string& word : {std::string("-I"), runtime, source, runtime + "/base/portable_math.cpp", std::string("-o"), temporary})
      command.push_back(word);
    const int status = run_program(command, log);
    std::string said = fs::exists(log, code) ? read_file(log) : "";
    fs::remove(log, code);
    fs::remove(source, code);
    if (status != 0) {
      const std::size_t error = said.find("error:");
      said = said.substr(error == std::string::npos ? 0 : said.rfind('\n', error) + 1);
      throw UserError(fmt::format("{} cannot compile the translated shader (status {}): {}", compiler, status,
                                  said.substr(0, said.find('\n'))));
    }
    std::string content = read_file(temporary);
    content += sha256_hex(content);
    write_file(temporary, content);
    fs::permissions(temporary, fs::perms::owner_exec, fs::perm_options::add, code);
  });
  return object;
}

}  // namespace twinshade
