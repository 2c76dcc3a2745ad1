#include "cpu_shaders/load/compiler.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "base/error.h"

extern char** environ;

namespace twinshade {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// As a shell finds it; empty if it is not there.
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

// A wrapper (ccache, a script) stays the same while the compiler behind it changes.
bool is_compiler_itself(const fs::path& program) {
  const std::string name = program.filename().string();
  if (name.find("g++") == std::string::npos && name.find("clang") == std::string::npos) return false;
  char magic[4] = {};
  std::ifstream(program, std::ios::binary).read(magic, sizeof magic);
  return std::string_view(magic, sizeof magic) ==
         "\x7f"
         "ELF";
}

// Path, size and time stand for a compiler's version, since asking it takes longer than loading a cached shader.
// Wrappers are asked.
std::string identity_of(const std::vector<std::string>& command) {
  std::string identity = fmt::format("{}", fmt::join(command, " "));
  std::error_code code;
  const fs::path real = fs::canonical(command[0], code);
  if (code) return identity;
  const auto time = fs::last_write_time(real, code).time_since_epoch().count();
  identity += fmt::format("\n{} {} {}", real.string(), fs::file_size(real, code), time);
  if (command.size() == 1 && is_compiler_itself(real)) return identity;
  std::vector<std::string> question = command;
  question.emplace_back("--version");
  return identity + "\n" + run_program(question).output;
}

// Code would give other values, or could not be loaded into this process. Flags that follow the command undo most of
// them; what was asked for is refused rather than ignored.
bool is_unusable(std::string_view word) {
  constexpr std::string_view kWords[] = {"-ffast-math",
                                         "-Ofast",
                                         "-funsafe-math-optimizations",
                                         "-ffinite-math-only",
                                         "-fassociative-math",
                                         "-freciprocal-math",
                                         "-fapprox-func",
                                         "-fsingle-precision-constant",
                                         "-mdaz-ftz",
                                         "-mrecip",
                                         "-fno-signed-zeros",
                                         "-m32",
                                         "-mx32",
                                         "-m16"};
  constexpr std::string_view kBeginnings[] = {"-fsanitize", "-ffp-model=", "-fdenormal-fp-math",
                                              "-mrecip=", "-mfpmath="};
  return std::ranges::find(kWords, word) != std::end(kWords) ||
         std::ranges::any_of(kBeginnings, [&](std::string_view beginning) { return word.starts_with(beginning); });
}

void refuse_unusable(const std::vector<std::string>& command, const std::string& given, bool by_environment) {
  for (const std::string& word : command)
    if (is_unusable(word))
      throw UserError(fmt::format("{}{}: {} makes shaders that give other values or cannot be loaded; leave it out",
                                  by_environment ? "CXX=" : "", given, word));
}

}  // namespace

Compiler find_compiler(const std::string& asked) {
  const char* cxx = std::getenv("CXX");
  const bool by_environment = asked.empty() && cxx && !words_of(cxx).empty();
  std::vector<std::string> candidates{"clang++", "g++", "c++"};
  if (!asked.empty() || by_environment) candidates = {by_environment ? cxx : asked};
  for (const std::string& candidate : candidates) {
    std::vector<std::string> command{candidate};
    if (find_program(candidate).empty()) command = words_of(candidate);
    refuse_unusable(command, candidate, by_environment);
    command[0] = find_program(command[0]);
    if (!command[0].empty()) return {command, identity_of(command)};
  }
  throw UserError(
      fmt::format("no C++ compiler found (tried {}{}): shaders, lanes and numbers that are not built in need one; {}",
                  by_environment ? "CXX=" : "", fmt::join(candidates, ", "),
                  by_environment ? "set CXX to one that is there, or unset it" : "install g++ or clang, or set CXX"));
}

ProgramResult run_program(const std::vector<std::string>& words) {
  // Limits are inherited: by the compiler proper, which the command starts.
  static const std::string limits = "ulimit -t 300 2>/dev/null; ulimit -v 4194304 2>/dev/null; exec \"$@\"";
  std::vector<char*> arguments;
  for (const char* word : {"/bin/sh", "-c", limits.c_str(), "sh"}) arguments.push_back(const_cast<char*>(word));
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {-1, std::string("no pipe: ") + std::strerror(errno)};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  ProgramResult result{-1, error == 0 ? "" : std::string("cannot be started: ") + std::strerror(error)};
  char buffer[4096];
  for (ssize_t count; (count = read(ends[0], buffer, sizeof buffer)) != 0 && (count > 0 || errno == EINTR);)
    if (count > 0) result.output.append(buffer, std::size_t(count));
  close(ends[0]);
  if (error != 0) return result;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
  return result;
}

}  // namespace twinshade
