// What a user waits for when a shader of 100 lines is drawn with for the first time, and the next time: on_demand_bench
// SHADER.frag
//   translated        GLSL to C++: first of a process (glslang reads its built-ins) and later
//   compiled, cold    an empty cache: the runtime is prepared for this compiler, then the shader compiled
//   compiled          another shader, with the runtime prepared
//   loaded, warm      load_module in a fresh process, from source to a function that can be called
// Milliseconds of processor time, children included, since other programs take turns with it; and by the wall clock.
// Number types: the widest lanes of this machine.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "base/error.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/translate/translate.h"

namespace {

using namespace twinshade;
namespace fs = std::filesystem;

double processor_milliseconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += 1e3 * double(time.tv_sec) + 1e-3 * double(time.tv_usec);
  }
  return sum;
}

void time(const char* what, const std::function<void()>& action) {
  const double before = processor_milliseconds();
  const auto start = std::chrono::steady_clock::now();
  action();
  const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{:<18} {:8.1f} ms of processor time, {:8.1f} ms by the clock\n", what, processor_milliseconds() - before,
             wall);
  std::fflush(stdout);
}

void in_fresh_process(const std::function<void()>& action) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    action();
    std::fflush(stdout);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

int run(const char* path) {
  const fs::path cache = fs::temp_directory_path() / fmt::format("twinshade_on_demand_bench_{}", getpid());
  setenv("TWINSHADE_CACHE", cache.c_str(), 1);
  const ShaderSource source = load_shader(path);
  const Isa isa = machine_isa();
  const Number number = isa == Isa::avx512 ? Number::lanes16 : isa == Isa::avx2 ? Number::lanes8 : Number::lanes4;
  time("translated, first", [&] { translate(source); });
  time("translated", [&] { translate(source); });
  const std::string cpp = translate(source).cpp;
  for (const char* compiler : {"clang++", "g++"}) {
    fmt::print("{}\n", compiler);
    time("compiled, cold", [&] { compile_shader(cpp, isa, number, compiler); });
    time("compiled", [&] { compile_shader(cpp + "// another\n", isa, number, compiler); });
  }
  in_fresh_process([&] { load_module(source, number); });
  for (int repeat = 0; repeat < 3; ++repeat)
    in_fresh_process([&] { time("loaded, warm", [&] { load_module(source, number); }); });
  fs::remove_all(cache);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: on_demand_bench SHADER.frag\n");
    return 2;
  }
  try {
    return run(arguments[1]);
  } catch (const UserError& error) {
    fmt::print(stderr, "on_demand_bench: {}\n", error.what());
    return 2;
  }
}
