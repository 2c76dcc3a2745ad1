// Translated C++ to a shared object, cached by content: the key is the C++, the runtime's headers (the ABI is one of
// them), the compiler and its flags. Objects are sealed, so that a damaged one is built again instead of loaded.
// Processes that race build the same thing under different temporary names; the last rename wins.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <sstream>
#include <vector>

#include "base/cache.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/load/run_program.h"
#include "cpu_shaders/load/runtime_files.h"
#include "cpu_shaders/load/source_index.h"
#include "cpu_shaders/machine.h"

namespace twinshade {
namespace {
namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kIsaFlags{TWINSHADE_FLAGS_BASELINE, TWINSHADE_FLAGS_AVX2, TWINSHADE_FLAGS_AVX512};

std::vector<std::string> flags_of(const CompileOptions& options) {
  std::istringstream words(fmt::format("-std=c++20 -O{} -fPIC -fvisibility=hidden -w {} {} -DTWINSHADE_ISA={}",
                                       options.optimisation, TWINSHADE_FLOAT_FLAGS, kIsaFlags[std::size_t(options.isa)],
                                       kIsaNames[std::size_t(options.isa)]));
  std::vector<std::string> flags;
  for (std::string word; words >> word;) flags.push_back(word);
  // DWARF 4: of 5 binutils (2.40) does not find what clang inlined.
  if (options.line_tables) flags.insert(flags.end(), {"-g1", "-gdwarf-4", "-fno-omit-frame-pointer"});
  return flags;
}

ProgramResult link(const Compiler& compiler, const std::vector<std::string>& flags,
                   const std::vector<std::string>& inputs, const std::string& target) {
  std::vector<std::string> command = compiler.command;
  command.insert(command.end(), flags.begin(), flags.end());
  command.emplace_back("-shared");
  command.insert(command.end(), inputs.begin(), inputs.end());
  command.insert(command.end(), {"-o", target});
  return run_program(command, kCompileTime, target);
}

// Symbol tables hold the source's name. One name in a folder for each: a text gives the same bytes whenever compiled.
struct SourceFolder {
  std::string path;
  explicit SourceFolder(const std::string& target) : path(target + ".source") {
    std::error_code code;
    fs::create_directory(path, code);
    if (code) throw UserError(path + ": cannot be created: " + code.message() + "; set TWINSHADE_CACHE");
  }
  ~SourceFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  SourceFolder(const SourceFolder&) = delete;
  SourceFolder& operator=(const SourceFolder&) = delete;
};

void build(const std::string& text, const Compiler& compiler, const CompileOptions& options,
           const std::string& target) {
  const std::string runtime = unpack_runtime();
  std::vector<std::string> flags = flags_of(options);
  flags.insert(flags.end(), {"-I", runtime});
  const PreparedRuntime prepared = prepare_runtime(runtime, compiler, flags);
  const SourceFolder folder(target);
  const std::string source = folder.path + "/shader.cpp";
  write_file(source, text);
  ProgramResult result = link(compiler, flags, {"-include", prepared.header, source, prepared.portable_math}, target);
  if (result.status != 0 && !result.timed_out) {  // the shader's fault, or the prepared runtime's?
    result = link(compiler, flags, {source, runtime + "/base/portable_math.cpp"}, target);
    if (result.status == 0) discard_prepared(prepared);
  }
  require_made(target, compiler, result, "the translated shader");
  seal(target);
}

}  // namespace

std::string object_key(std::string_view content, const CompileOptions& options) {
  const std::string flags = fmt::format("{}", fmt::join(flags_of(options), " "));
  Sha256 hash;
  for (const std::string& part : {std::to_string(kAbiVersion), embedded_runtime_hash(),
                                  find_compiler(options.compiler).identity, flags, std::to_string(options.numbers)}) {
    hash.add(part);
    hash.add("\0", 1);
  }
  hash.add(content);
  return hash.hex();
}

std::string compile_shader(const std::string& cpp, const CompileOptions& options) {
  const std::string object = cache_folder() + "/shader-" + object_key(cpp, options) + ".so";
  if (is_sealed(object)) {
    touch_cached(object);
    return object;
  }
  require_writable_cache();
  // Definitions that differ between shaders are text: the precompiled runtime, which does not look at them, serves all.
  const std::string text =
      fmt::format("#define TWINSHADE_NUMBERS {}\n#define TWINSHADE_SHARED_OBJECT 1\n#line 1\n{}", options.numbers, cpp);
  const Compiler compiler = find_compiler(options.compiler);
  write_cached_with(object, [&](const std::string& temporary) { build(text, compiler, options, temporary); });
  trim_cache();
  return object;
}

}  // namespace twinshade
