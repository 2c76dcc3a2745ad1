// Layout, below runtime-HASH of the cache: the headers under their own names; for each compiler and set of flags a
// folder with a header that includes the runtime, its precompiled form for clang++ (which looks for header.gch), that
// one's hash, and base/portable_math.o. Parsing the runtime takes half the time of a shader of 100 lines.
#include "cpu_shaders/load/runtime_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <span>
#include <string_view>

#include "base/cache.h"
#include "base/embedded_file.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"

namespace twinshade {

std::span<const EmbeddedFile> embedded_runtime();  // made by the build

namespace {
namespace fs = std::filesystem;

// A precompiled header cannot be sealed: clang++ reads it to its end.
bool matches_hash_file(const std::string& path) {
  std::error_code code;
  const std::string hash_file = path + ".sha256";
  return fs::is_regular_file(path, code) && fs::is_regular_file(hash_file, code) &&
         read_file(hash_file) == sha256_hex(read_file(path));
}

// The first line that says "error:", else the first one.
std::string first_complaint(const std::string& output) {
  const std::size_t error = output.find("error:");
  const std::size_t begin =
      error == std::string::npos ? output.find_first_not_of(" \n") : output.rfind('\n', error) + 1;
  return begin == std::string::npos ? "" : output.substr(begin, output.find('\n', begin) - begin);
}

// A compiler that crashed, or met the limits of run_program, says nothing that could be put right in the source.
bool broke_down(const ProgramResult& result) {
  constexpr std::string_view kSigns[] = {"unable to execute command", "internal compiler error", "terminated program",
                                         "out of memory", "memory exhausted"};
  return (result.started && result.status < 0) || std::ranges::any_of(kSigns, [&](std::string_view sign) {
           return result.output.find(sign) != std::string::npos;
         });
}

void compile_part(const Compiler& compiler, const std::vector<std::string>& flags,
                  const std::vector<std::string>& files, const std::string& target) {
  std::vector<std::string> command = compiler.command;
  command.insert(command.end(), flags.begin(), flags.end());
  command.insert(command.end(), files.begin(), files.end());
  command.insert(command.end(), {"-o", target});
  require_made(target, compiler, run_program(command, kCompileTime, target), "the runtime of translated shaders");
}

// Side by side: the first shader of all waits for both.
void make_parts(const PreparedRuntime& prepared, const std::string& runtime, const Compiler& compiler,
                const std::vector<std::string>& flags) {
  std::future<void> math = std::async(std::launch::async, [&] {
    if (is_sealed(prepared.portable_math)) return;
    write_cached_with(prepared.portable_math, [&](const std::string& temporary) {
      compile_part(compiler, flags, {"-c", runtime + "/base/portable_math.cpp"}, temporary);
      seal(temporary);
    });
  });
  // clang++ makes it in a second and saves half of each shader's; g++ takes five times what it saves.
  const bool is_clang = compiler.identity.find("clang") != std::string::npos;
  if (const std::string precompiled = prepared.header + ".gch"; is_clang && !matches_hash_file(precompiled)) {
    write_cached_with(precompiled, [&](const std::string& temporary) {
      compile_part(compiler, flags, {"-x", "c++-header", prepared.header}, temporary);
      write_cached(precompiled + ".sha256", sha256_hex(read_file(temporary)));
    });
  }
  math.get();
}

}  // namespace

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

std::string unpack_runtime() {
  const fs::path name = "runtime-" + embedded_runtime_hash().substr(0, 16);
  const std::string folder = make_cache_folder(name.string());
  std::error_code code;
  for (const EmbeddedFile& file : embedded_runtime()) {
    const fs::path below = name / std::string(file.path);
    const std::string path = make_cache_folder(below.parent_path().string()) + "/" + below.filename().string();
    if (!fs::is_regular_file(path, code) || read_file(path) != file.content) write_cached(path, file.content);
  }
  touch_cached(folder);
  return folder;
}

PreparedRuntime prepare_runtime(const std::string& runtime, const Compiler& compiler,
                                const std::vector<std::string>& flags) {
  static std::mutex mutex;  // threads wait for one instead of all making it
  const std::lock_guard lock(mutex);
  const std::string key = sha256_hex(fmt::format("{}\n{}", compiler.identity, fmt::join(flags, " "))).substr(0, 16);
  const fs::path folder = make_cache_folder((fs::path(runtime).filename() / ("prepared-" + key)).string());
  const PreparedRuntime prepared{(folder / "runtime.h").string(), (folder / "portable_math.o").string()};
  std::error_code code;
  if (!fs::is_regular_file(prepared.header, code))
    write_cached(prepared.header, "#include \"cpu_shaders/runtime/runtime.h\"\n");
  static std::map<std::string, std::string> timed_out;  // by key: its error
  if (const auto before = timed_out.find(key); before != timed_out.end()) throw CompilerTimeout(before->second);
  try {
    make_parts(prepared, runtime, compiler, flags);
  } catch (const CompilerTimeout& error) {
    timed_out[key] = error.what();
    throw;
  }
  return prepared;
}

void discard_prepared(const PreparedRuntime& prepared) {
  std::error_code ignored;
  fs::remove_all(fs::path(prepared.header).parent_path(), ignored);
}

void require_made(const std::string& made, const Compiler& compiler, const ProgramResult& result,
                  const std::string& what) {
  std::error_code code;
  if (result.status == 0 && fs::is_regular_file(made, code)) return;
  const std::string command = fmt::format("{}", fmt::join(compiler.command, " "));
  if (result.timed_out)
    throw CompilerTimeout(
        fmt::format("{} cannot compile {}: it has not ended within {} s; set CXX to a C++ compiler that works", command,
                    what, kCompileTime.count()));
  const std::string said = first_complaint(result.output);
  if (result.status != 0 && !said.empty())
    throw UserError(fmt::format("{} cannot compile {} (status {}): {}{}", command, what, result.status, said,
                                broke_down(result) ? "; perhaps it is too large for the compiler: split it up, or set "
                                                     "CXX to another one"
                                                   : ""));
  std::string end = "made no object, though its exit code is 0";
  if (result.status > 0) end = fmt::format("failed with exit code {} and no message", result.status);
  if (result.status < 0) end = "was killed, with no message";
  throw UserError(fmt::format("{} cannot compile {}: it {}; set CXX to a C++ compiler that works", command, what, end));
}

}  // namespace twinshade
