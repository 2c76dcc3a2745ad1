// The compiler that is found, and the objects it makes: cached, checked, shared between processes.
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <bit>
#include <cmath>
#include <thread>
#include <vector>

#include "base/file.h"
#include "base/hash.h"
#include "cpu_shaders/load/compiler.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/load/open.h"
#include "cpu_shaders/load/source_index.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/translate/translate.h"
#include "tests/load/cache_fixture.h"

using namespace twinshade;
namespace fs = std::filesystem;

namespace {

std::string compile(const std::string& body, const std::string& compiler = {}) {
  return compile_shader(translate(small_shader(body)).cpp, Isa::baseline, Number::scalar, compiler);
}

double run(const std::string& object, double x, double y, double z) {
  void* library = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  REQUIRE_MESSAGE(library != nullptr, object);
  const auto* module = static_cast<const ShaderModule*>(dlsym(library, kModuleSymbol));
  REQUIRE(module != nullptr);
  return run_module(*module, Number::scalar, {x, y, z}, 1)[0];
}

std::vector<fs::path> files_named(const std::string& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
  return files;
}

std::string read_or_nothing(const std::string& path) { return fs::exists(path) ? read_file(path) : ""; }

void truncate_to_half(const std::string& path) {
  const std::string content = read_file(path);
  write_file(path, content.substr(0, content.size() / 2));
}

void write_program(const std::string& path, const std::string& text) {
  write_file(path, text);
  fs::permissions(path, fs::perms::owner_all);
}

}  // namespace

TEST_CASE("a compiled shader is taken from the cache, and a damaged one is built again") {
  shared_cache();
  const std::string path = compile("r = a.x;");
  const std::string content = read_file(path);
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(24);
  fs::last_write_time(path, long_ago);
  CHECK(compile("r = a.x;") == path);
  CHECK_MESSAGE(fs::last_write_time(path) > long_ago, "a use is not recorded");
  for (const std::size_t length : {std::size_t(0), content.size() / 2, content.size() - 1}) {
    write_file(path, content.substr(0, length));
    CHECK(compile("r = a.x;") == path);
    CHECK((read_file(path) == content));
  }
  std::string damaged = content;
  damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 1);
  write_file(path, damaged);
  compile("r = a.x;");
  CHECK(read_file(path) != damaged);
  CHECK(run(path, 1.5, 0, 0) == 1.5);
}

TEST_CASE("an object's bytes do not depend on the name of the temporary file that it was made as") {
  const TestCache& cache = shared_cache();
  const std::string path = compile("r = a.x;");
  const std::string content = read_file(path);
  for (int i = 0; i < 1000; ++i)  // their numbers go up: the next names are longer
    write_file(cache.folder + "/any", "");
  fs::remove(path);
  REQUIRE(compile("r = a.x;") == path);
  CHECK((read_file(path) == content));
}

TEST_CASE(
    "a prepared runtime that is damaged, or that its compiler refuses, does not stop a shader and is made again") {
  const TestCache cache;
  compile("r = a.x;");
  const std::string mathematics = files_named(cache.folder, "portable_math.o").at(0).string();
  const std::uintmax_t mathematics_size = fs::file_size(mathematics);
  truncate_to_half(mathematics);
  const auto headers = files_named(cache.folder, ".gch");
  if (headers.empty()) {  // no clang++ here
    CHECK(run(compile("r = exp(a.x);"), 0, 0, 0) == 1);
    CHECK(fs::file_size(mathematics) == mathematics_size);
    return;
  }
  const std::string precompiled = headers.at(0).string();
  const std::uintmax_t precompiled_size = fs::file_size(precompiled);
  truncate_to_half(precompiled);
  CHECK(run(compile("r = exp(a.x);"), 0, 0, 0) == 1);
  CHECK(fs::file_size(precompiled) == precompiled_size);
  CHECK(fs::file_size(mathematics) == mathematics_size);

  const std::string nonsense = "CPCH, but no more";  // whole by its hash
  write_file(precompiled, nonsense);
  write_file(precompiled + ".sha256", sha256_hex(nonsense));
  CHECK(run(compile("r = exp(a.y);"), 1, 0, 0) == 1);
  CHECK(read_or_nothing(precompiled) != nonsense);
}

TEST_CASE("a source that was compiled before is found without translating it, unless its object is damaged or gone") {
  shared_cache();
  const CompileOptions options{Isa::baseline, 1u << int(Number::scalar), 2, {}};
  const ShaderSource source = small_shader("r = a.x + 0.5;");
  const IndexedSource indexed(source, options);
  CHECK(indexed.find().empty());
  const std::string object = compile("r = a.x + 0.5;");
  indexed.remember(object);
  CHECK(IndexedSource(source, options).find() == object);
  CHECK(IndexedSource(small_shader("r = a.x + 0.25;"), options).find().empty());
  CHECK(IndexedSource(source, CompileOptions{Isa::baseline, 1u << int(Number::scalar), 1, {}}).find().empty());
  ShaderSource renamed = source;
  renamed.name = "another";
  CHECK(IndexedSource(renamed, options).find().empty());
  truncate_to_half(object);
  CHECK(indexed.find().empty());
  fs::remove(object);
  CHECK(indexed.find().empty());
}

TEST_CASE("racing threads and processes all get a whole object") {
  const TestCache& cache = shared_cache();
  const std::string cpp = translate(small_shader("r = a.y;")).cpp;
  constexpr int kProcesses = 3;
  std::vector<pid_t> children;
  for (int k = 0; k < kProcesses; ++k) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child != 0) {
      children.push_back(child);
      continue;
    }
    int status = 1;
    try {
      const std::string object = compile_shader(cpp, Isa::baseline, Number::scalar);
      status = dlopen(object.c_str(), RTLD_NOW) ? 0 : 2;
    } catch (...) {
    }
    _exit(status);
  }
  std::vector<std::string> paths(2);
  std::vector<std::thread> threads;
  for (std::string& path : paths)
    threads.emplace_back([&path, &cpp] { path = compile_shader(cpp, Isa::baseline, Number::scalar); });
  for (std::thread& thread : threads) thread.join();
  for (const pid_t child : children) {
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  CHECK(paths[0] == paths[1]);
  CHECK(run(paths[0], 0, 4.5, 0) == 4.5);
  for (const auto& entry : fs::recursive_directory_iterator(cache.folder))
    CHECK_MESSAGE(!entry.path().filename().string().starts_with("."), entry.path().string());
  CHECK(files_named(cache.folder, ".so").size() == 1);
}

TEST_CASE("both compilers make code that gives the same bits") {
  shared_cache();
  std::vector<double> results;
  for (const char* compiler : {"g++", "clang++"}) {
    std::string path;
    const std::string message = message_of(
        [&] { path = compile("r = (a.x * a.y - a.z) / (a.x + 3.0) + sqrt(abs(a.y)) + sin(a.z);", compiler); });
    if (message.find("no C++ compiler") != std::string::npos) {
      MESSAGE(std::string(compiler) << " is missing: not tried");
      continue;
    }
    REQUIRE_MESSAGE(message == "no error", message);
    results.push_back(run(path, 0.3, 1.7, -2.9));
  }
  for (const double result : results)
    CHECK(std::bit_cast<std::uint64_t>(result) == std::bit_cast<std::uint64_t>(results[0]));
}

TEST_CASE("a compiler asked for by name or by CXX is the one, or none") {
  shared_cache();
  const std::string compiler = find_compiler().command[0];
  {
    const TestVariable cxx("CXX", compiler.c_str());
    CHECK(find_compiler().command == std::vector<std::string>{compiler});
    CHECK(find_compiler("  " + compiler + " -m64").command == std::vector<std::string>{compiler, "-m64"});
  }
  const TestVariable cxx("CXX", "no-such-compiler");
  CHECK_THROWS_WITH_AS(find_compiler(), doctest::Contains("CXX=no-such-compiler"), UserError);
  CHECK_THROWS_WITH_AS(find_compiler("nor-this"), doctest::Contains("nor-this"), UserError);
}

TEST_CASE("words in CXX that change values, or make what cannot be loaded, are refused by name") {
  shared_cache();
  const std::string compiler = find_compiler().command[0];
  for (const char* word : {"-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-ffinite-math-only",
                           "-fassociative-math", "-freciprocal-math", "-fno-signed-zeros", "-fsanitize=address",
                           "-fsanitize-recover=all", "-ffp-model=fast", "-mfpmath=387", "-m32"}) {
    const std::string given = compiler + " -O3 " + word;
    const TestVariable cxx("CXX", given.c_str());
    const std::string message = message_of([] { compile("r = a.x;"); });
    CHECK(message ==
          "CXX=" + given + ": " + word + " makes shaders that give other values or cannot be loaded; leave it out");
  }
  const TestVariable cxx("CXX", (compiler + " -O3 -march=x86-64 -Wall").c_str());
  CHECK(find_compiler().command.size() == 4);
}

TEST_CASE("what a wrapper adds before the flags changes no value") {
  const TestCache cache;
  for (const char* compiler : {"g++", "clang++"}) {
    if (message_of([&] { find_compiler(compiler); }) != "no error") continue;  // not here
    const std::string real = find_compiler(compiler).command[0];
    for (const char* flags : {"-O3 -ffast-math", "-Ofast", "-funsafe-math-optimizations", "-ffinite-math-only",
                              "-fassociative-math -fno-signed-zeros", "-freciprocal-math", "-fsanitize=address"}) {
      const std::string wrapper = cache.folder + "/wrapper";
      const std::string wrapper_text = "#!/bin/sh\nexec " + real + " " + flags + " \"$@\"\n";
      write_program(wrapper, wrapper_text);
      const std::string object = compile("r = (a.x + a.y) - a.y + (isnan(a.z) ? 1.0 : 0.0);", wrapper);
      CHECK_MESSAGE(run(object, 1, 1e10, std::nan("")) == 1, wrapper_text);
    }
  }
}

TEST_CASE("a wrapper is known by the compiler behind it") {
  const TestCache& cache = shared_cache();
  const std::string wrapper = cache.folder + "/wrapped-clang++", version = cache.folder + "/version";
  write_program(wrapper, "#!/bin/sh\ncat " + version + "\n");
  write_file(version, "12.1");
  const std::string before = find_compiler(wrapper).identity;
  CHECK(find_compiler(wrapper).identity == before);
  write_file(version, "12.2");
  CHECK(find_compiler(wrapper).identity != before);
}

TEST_CASE("what a compiler complains of is one line, and nothing is left behind") {
  const TestCache& cache = shared_cache();
  const std::string message =
      message_of([] { compile_shader("#line 7 \"mine.frag\"\nint x = nonsense;\n", Isa::baseline, Number::scalar); });
  CHECK_MESSAGE(message.find("mine.frag:7:") != std::string::npos, message);
  CHECK(message.find('\n') == std::string::npos);
  CHECK(files_named(cache.folder, ".so").empty());
  CHECK(files_named(cache.folder, ".cpp").size() == 1);  // the runtime's
  for (const auto& entry : fs::recursive_directory_iterator(cache.folder))
    CHECK_MESSAGE(!entry.path().filename().string().starts_with(".twinshade-"), entry.path().string());
}

TEST_CASE("a compiler that makes nothing, or fails without a word, is named with a remedy") {
  const TestCache cache;
  const auto said_of = [](const std::string& compiler) { return message_of([&] { compile("r = a.x;", compiler); }); };
  for (const auto& [program, what] : {std::pair<std::string, std::string>{"exit 0", "made no object"},
                                      {"exit 3", "failed with exit code 3 and no message"},
                                      {"kill -9 $$", "was killed"}}) {
    const std::string compiler = cache.folder + "/compiler";
    write_program(compiler, "#!/bin/sh\n" + program + "\n");
    const std::string message = said_of(compiler);
    CHECK_MESSAGE(message.find(compiler + " cannot compile the runtime of translated shaders: it " + what) == 0,
                  message);
    CHECK_MESSAGE(message.ends_with("set CXX to a C++ compiler that works"), message);
  }
  CHECK(files_named(cache.folder, ".so").empty());
}

TEST_CASE("a compiler that crashes is said to be perhaps too small for the shader, and its report goes") {
  const TestCache cache, temporaries;
  const TestVariable own("TWINSHADE_CACHE", cache.folder.c_str()), folder("TMPDIR", temporaries.folder.c_str());
  const std::string compiler = cache.folder + "/compiler";
  write_program(compiler,
                "#!/bin/sh\necho x > $TMPDIR/report.cpp\n"
                "echo 'clang: error: unable to execute command: Segmentation fault' >&2\nexit 254\n");
  const std::string message = message_of([&] { compile("r = a.x;", compiler); });
  CHECK_MESSAGE(
      message.ends_with("(status 254): clang: error: unable to execute command: Segmentation fault; perhaps it "
                        "is too large for the compiler: split it up, or set CXX to another one"),
      message);
  CHECK(fs::is_empty(temporaries.folder));
}

TEST_CASE("an object that cannot be loaded goes, and its compiler is to be replaced") {
  const TestCache cache;
  const std::string compiler = cache.folder + "/compiler";
  write_program(compiler,
                "#!/bin/sh\nwhile [ $# -gt 0 ]; do if [ \"$1\" = -o ]; then echo garbage > \"$2\"; fi; shift; done\n");
  const std::string object = compile("r = a.x;", compiler);
  const std::string message = message_of([&] { open_module(object, kModuleSymbol); });
  CHECK_MESSAGE(message.find(object + ": compiled shader cannot be loaded: ") == 0, message);
  CHECK_MESSAGE(
      message.find("; it was removed; set CXX to a C++ compiler that works, or TWINSHADE_CACHE") != message.npos,
      message);
  CHECK(!fs::exists(object));
}

TEST_CASE("entries of the cache of the wrong kind are built again") {
  const TestCache cache;
  const std::string object = compile("r = a.x;");
  const auto becomes_folder = [](const std::string& path) {
    fs::remove_all(path);
    fs::create_directories(path + "/within");
  };
  becomes_folder(object);
  becomes_folder(files_named(cache.folder, "portable_math.o").at(0).string());
  becomes_folder(files_named(cache.folder, "runtime/runtime.h").at(0).string());
  for (const fs::path& precompiled : files_named(cache.folder, ".gch")) becomes_folder(precompiled.string());
  CHECK(compile("r = a.x;") == object);
  CHECK(run(object, 1.5, 0, 0) == 1.5);

  fs::remove(object);
  fs::create_symlink("/dev/zero", object);
  std::string runtime;
  for (const auto& entry : fs::directory_iterator(cache.folder))
    if (entry.path().filename().string().starts_with("runtime-")) runtime = entry.path().string();
  fs::remove_all(runtime);
  write_file(runtime, "a file");
  CHECK(compile("r = a.x;") == object);
  CHECK(fs::is_directory(runtime));
  CHECK(fs::is_regular_file(fs::symlink_status(object)));
}

TEST_CASE("an index of sources of the wrong kind is written again") {
  const TestCache& cache = shared_cache();
  const CompileOptions options{Isa::baseline, 1u << int(Number::scalar), 2, {}};
  const IndexedSource indexed(small_shader("r = a.x + 2.0;"), options);
  const std::string object = compile("r = a.x + 2.0;");
  indexed.remember(object);
  const std::string index = files_named(cache.folder, ".object").at(0).string();
  fs::remove(index);
  fs::create_directories(index);
  CHECK(indexed.find().empty());
  indexed.remember(object);
  CHECK(indexed.find() == object);
}

TEST_CASE("a size of the cache that is none is said before anything is translated") {
  shared_cache();
  const TestVariable size("TWINSHADE_CACHE_SIZE", "1.5G");
  const CompileOptions options{Isa::baseline, 1u << int(Number::scalar), 2, {}};
  const std::string message = message_of([&] { IndexedSource(small_shader("r = a.x;"), options); });
  CHECK_MESSAGE(message.find("TWINSHADE_CACHE_SIZE=1.5G") == 0, message);
}
