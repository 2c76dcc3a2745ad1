// Layout, below runtime-HASH of the cache: the headers under their own names; for each compiler and set of flags a
// folder with a header that includes the runtime, its precompiled form for clang++ (which looks for header.gch), that
// one's hash, and base/portable_math.o. Parsing the runtime takes half the time of a shader of 100 lines.
#include "cpu_shaders/load/runtime_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <future>
#include <mutex>
#include <span>

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
  return fs::exists(path, code) && fs::exists(hash_file, code) && read_file(hash_file) == sha256_hex(read_file(path));
}

void compile_part(const Compiler& compiler, const std::vector<std::string>& flags,
                  const std::vector<std::string>& files, const std::string& target) {
  std::vector<std::string> command = compiler.command;
  command.insert(command.end(), flags.begin(), flags.end());
  command.insert(command.end(), files.begin(), files.end());
  command.insert(command.end(), {"-o", target});
  if (const ProgramResult result = run_program(command); result.status != 0)
    throw_compiler_error(compiler, result, "the runtime of translated shaders");
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
  const fs::path folder = fs::path(cache_folder()) / ("runtime-" + embedded_runtime_hash().substr(0, 16));
  std::error_code code;
  for (const EmbeddedFile& file : embedded_runtime()) {
    const fs::path path = folder / std::string(file.path);
    if (fs::exists(path, code) && read_file(path.string()) == file.content) continue;
    fs::create_directories(path.parent_path(), code);
    write_file(path.string(), file.content);
  }
  touch_cached(folder.string());
  return folder.string();
}

PreparedRuntime prepare_runtime(const std::string& runtime, const Compiler& compiler,
                                const std::vector<std::string>& flags) {
  static std::mutex mutex;  // threads wait for one instead of all making it
  const std::lock_guard lock(mutex);
  const std::string key = sha256_hex(fmt::format("{}\n{}", compiler.identity, fmt::join(flags, " "))).substr(0, 16);
  const fs::path folder = fs::path(runtime) / ("prepared-" + key);
  const PreparedRuntime prepared{(folder / "runtime.h").string(), (folder / "portable_math.o").string()};
  std::error_code code;
  fs::create_directories(folder, code);
  if (!fs::exists(prepared.header, code)) write_file(prepared.header, "#include \"cpu_shaders/runtime/runtime.h\"\n");
  // Side by side: the first shader of all waits for both.
  std::future<void> math = std::async(std::launch::async, [&] {
    if (is_sealed(prepared.portable_math)) return;
    write_file_with(prepared.portable_math, [&](const std::string& temporary) {
      compile_part(compiler, flags, {"-c", runtime + "/base/portable_math.cpp"}, temporary);
      seal(temporary);
    });
  });
  // clang++ makes it in a second and saves half of each shader's; g++ takes five times what it saves.
  const bool is_clang = compiler.identity.find("clang") != std::string::npos;
  if (const std::string precompiled = prepared.header + ".gch"; is_clang && !matches_hash_file(precompiled)) {
    write_file_with(precompiled, [&](const std::string& temporary) {
      compile_part(compiler, flags, {"-x", "c++-header", prepared.header}, temporary);
      write_file(precompiled + ".sha256", sha256_hex(read_file(temporary)));
    });
  }
  math.get();
  return prepared;
}

void discard_prepared(const PreparedRuntime& prepared) {
  std::error_code ignored;
  fs::remove_all(fs::path(prepared.header).parent_path(), ignored);
}

void throw_compiler_error(const Compiler& compiler, const ProgramResult& result, const std::string& what) {
  const std::size_t error = result.output.find("error:");
  const std::string said = result.output.substr(error == std::string::npos ? 0 : result.output.rfind('\n', error) + 1);
  throw UserError(fmt::format("{} cannot compile {} (status {}): {}", fmt::join(compiler.command, " "), what,
                              result.status, said.substr(0, said.find('\n'))));
}

}  // namespace twinshade
