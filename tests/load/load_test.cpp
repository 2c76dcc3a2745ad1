#include "cpu_shaders/load/load.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/runtime/machine.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"

using namespace twinshade;
namespace fs = std::filesystem;

namespace {

// A cache of its own for each test, gone afterwards.
struct Cache {
  std::string folder = (fs::temp_directory_path() / ("twinshade_load_test_" + std::to_string(getpid()))).string();
  Cache() {
    fs::remove_all(folder);
    setenv("TWINSHADE_CACHE", folder.c_str(), 1);
  }
  ~Cache() { fs::remove_all(folder); }
};

ShaderSource shader(const std::string& body) {
  return resolve_shader("test", "in vec3 a;\nout float r;\nvoid main() {\n" + body + "\n}\n", "test.frag");
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("built-in techniques are found by what they say, not by what they are called") {
  for (const TechniqueInfo& technique : techniques())
    for (const CoefficientStorage storage :
         {CoefficientStorage::lightmap, CoefficientStorage::vertex, CoefficientStorage::volume}) {
      if (!can_read(technique, storage)) continue;
      // Of precomputed visibility only lightmaps are built in
      if (technique.weights != VisibilityWeights::none && storage != CoefficientStorage::lightmap) continue;
      ShaderSource source = technique_source(technique, storage);
      const ShaderModule* module = find_builtin_module(source);
      REQUIRE_MESSAGE(module != nullptr, source.name);
      CHECK(module->abi_version == kAbiVersion);
      CHECK(source_hash(source) == module->source_hash);
      bool has_lanes4 = false;
      for (std::uint32_t i = 0; i < module->entry_count; ++i) has_lanes4 |= module->entries[i].number == Number::lanes4;
      CHECK(has_lanes4);
      source.text += " ";
      CHECK(find_builtin_module(source) == nullptr);
    }
}

TEST_CASE("a shader compiled on demand is never contracted into fused multiply-adds") {
  const Cache cache;
  // 1 + 2^-12 squared minus its rounded square: 2^-24 where a * b + c is fused, 0 where the product is rounded first.
  const double x = 1.0 + 0x1p-12, negative_square = -double(float(x * x));
  for (const Number number : {Number::scalar}) {
    const ShaderModule& module = load_module(shader("r = a.x * a.y + a.z;"), number);
    CHECK(run_module(module, number, {x, x, negative_square}, 1)[0] == 0.0);
  }
  // The compiler's own flags, for an instruction set that has the fused operation.
  if (machine_isa() >= Isa::avx2) {
    const std::string object = compile_shader(translate(shader("r = a.x * a.y + a.z;")).cpp, Isa::avx2, Number::lanes8);
    const std::string disassembly = "objdump -d " + object + " 2>/dev/null | grep -c vfmadd";
    if (std::system("objdump --version >/dev/null 2>&1") == 0)
      CHECK(std::system((disassembly + " >/dev/null").c_str()) != 0);
    else
      MESSAGE("objdump is missing: the fused instructions of the AVX2 object were not looked for");
  }
}

TEST_CASE("a compiled shader is taken from the cache, and a damaged one is built again") {
  const Cache cache;
  const std::string cpp = translate(shader("r = a.x;")).cpp;
  const std::string path = compile_shader(cpp, Isa::baseline, Number::scalar);
  const auto time = fs::last_write_time(path);
  const std::string content = read_file(path);
  CHECK(compile_shader(cpp, Isa::baseline, Number::scalar) == path);
  CHECK(fs::last_write_time(path) == time);
  for (const std::size_t length : {std::size_t(0), std::size_t(10), content.size() / 2, content.size() - 1}) {
    write_file(path, content.substr(0, length));
    CHECK(compile_shader(cpp, Isa::baseline, Number::scalar) == path);
    CHECK(fs::file_size(path) == content.size());
  }
  std::string damaged = content;
  damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 1);
  write_file(path, damaged);
  compile_shader(cpp, Isa::baseline, Number::scalar);
  CHECK(read_file(path) != damaged);
}

TEST_CASE("racing builders of one shader all get a whole object") {
  const Cache cache;
  const std::string cpp = translate(shader("r = a.y;")).cpp;
  std::vector<std::string> paths(4);
  std::vector<std::thread> threads;
  for (std::string& path : paths)
    threads.emplace_back([&path, &cpp] { path = compile_shader(cpp, Isa::baseline, Number::scalar); });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& path : paths) CHECK(path == paths[0]);
  int left_over = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(paths[0]).parent_path()))
    left_over += entry.path().extension() != ".so" || entry.path().filename().string()[0] == '.';
  CHECK(left_over == 0);
}

TEST_CASE("without a compiler the message says what to install, and built-in techniques still load") {
  const Cache cache;
  const std::string path = std::getenv("PATH");
  const char* cxx = std::getenv("CXX");
  const std::string old_cxx = cxx ? cxx : "";
  setenv("PATH", "/nonexistent", 1);
  unsetenv("CXX");
  const std::string message = message_of([] { load_module(shader("r = a.z;"), Number::scalar); });
  const TechniqueInfo& h4 = find_technique("h4");
  CHECK_NOTHROW(load_module(technique_source(h4, CoefficientStorage::lightmap), Number::lanes4));
  setenv("PATH", path.c_str(), 1);
  if (cxx) setenv("CXX", old_cxx.c_str(), 1);
  CHECK_MESSAGE(message.find("install") != std::string::npos, message);
  CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("both compilers make code that gives the same bits") {
  const Cache cache;
  const std::string cpp = translate(shader("r = (a.x * a.y - a.z) / (a.x + 3.0) + sqrt(abs(a.y));")).cpp;
  for (const char* compiler : {"g++", "clang++"}) {
    std::string path;
    const std::string message =
        message_of([&] { path = compile_shader(cpp, Isa::baseline, Number::scalar, compiler); });
    if (message.find("no C++ compiler") != std::string::npos)
      MESSAGE(std::string(compiler) << " is missing: not tried");
    else
      CHECK_MESSAGE(message == "no error", message);
  }
}

TEST_CASE("an instruction set that the machine lacks is refused by name") {
  if (machine_isa() == Isa::avx512) {
    MESSAGE("this machine has every instruction set: nothing to refuse");
    return;
  }
  const std::string message = message_of([] { load_module(shader("r = a.x;"), Number::lanes16, Isa::avx512); });
  CHECK_MESSAGE(message.find("avx512") != std::string::npos, message);
}
