#include "cpu_shaders/load/compiler.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "cpu_shaders/load/run_program.h"

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

// What a wrapper says of itself; one that does not answer is asked once in this process, not by each of a thousand
// shaders.
std::string version_of(std::vector<std::string> command, const std::string& identity,
                       std::chrono::milliseconds patience) {
  static std::mutex mutex;
  static std::set<std::string> silent;
  const std::lock_guard lock(mutex);
  command.emplace_back("--version");
  ProgramResult answer;
  answer.timed_out = silent.count(identity) != 0;
  if (!answer.timed_out) answer = run_program(command, patience);
  if (answer.timed_out) {
    silent.insert(identity);
    throw CompilerTimeout(fmt::format("{} does not answer within {} s; set CXX to a C++ compiler that works",
                                      fmt::join(command, " "), patience.count() / 1000));
  }
  return answer.output;
}

// Path, size and time stand for a compiler's version, since asking it takes longer than loading a cached shader.
// Wrappers are asked.
std::string identity_of(const std::vector<std::string>& command, std::chrono::milliseconds patience) {
  std::string identity = fmt::format("{}", fmt::join(command, " "));
  std::error_code code;
  const fs::path real = fs::canonical(command[0], code);
  if (code) return identity;
  const auto time = fs::last_write_time(real, code).time_since_epoch().count();
  identity += fmt::format("\n{} {} {}", real.string(), fs::file_size(real, code), time);
  if (command.size() == 1 && is_compiler_itself(real)) return identity;
  return identity + "\n" + version_of(command, identity, patience);
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
                                         "-ftrapv",
                                         "-m32",
                                         "-mx32",
                                         "-m16"};
  constexpr std::string_view kBeginnings[] = {"-fsanitize", "-ffp-model=fast", "-fdenormal-fp-math=p",
                                              "-mrecip=",   "-mfpmath=387",    "-mfpmath=both"};
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

Compiler find_compiler(const std::string& asked, std::chrono::milliseconds patience) {
  const char* cxx = std::getenv("CXX");
  const bool by_environment = asked.empty() && cxx && !words_of(cxx).empty();
  std::vector<std::string> candidates{"clang++", "g++", "c++"};
  if (!asked.empty() || by_environment) candidates = {by_environment ? cxx : asked};
  for (const std::string& candidate : candidates) {
    std::vector<std::string> command{candidate};
    if (find_program(candidate).empty()) command = words_of(candidate);
    refuse_unusable(command, candidate, by_environment);
    command[0] = find_program(command[0]);
    if (!command[0].empty()) return {command, identity_of(command, patience)};
  }
  throw UserError(
      fmt::format("no C++ compiler found (tried {}{}): shaders, lanes and numbers that are not built in need one; {}",
                  by_environment ? "CXX=" : "", fmt::join(candidates, ", "),
                  by_environment ? "set CXX to one that is there, or unset it" : "install g++ or clang, or set CXX"));
}

}  // namespace twinshade
