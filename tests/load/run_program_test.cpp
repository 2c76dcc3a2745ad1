// Programs that are waited for: what they leave behind, and what is left of them when this process ends.
#include "cpu_shaders/load/run_program.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "base/file.h"
#include "cpu_shaders/load/compiler.h"
#include "cpu_shaders/load/runtime_files.h"
#include "tests/load/cache_fixture.h"

using namespace twinshade;
namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

ProgramResult run_script(const std::string& script, milliseconds time = seconds(20), const std::string& made = {}) {
  return run_program({"/bin/sh", "-c", script}, time, made);
}

// Zombies have no command line: whoever adopted them has not looked yet. process: a number, perhaps with an end of
// line.
bool runs(const std::string& process) {
  std::ifstream file("/proc/" + std::to_string(std::stoi(process)) + "/cmdline");
  return file.get() != std::ifstream::traits_type::eof();
}

// True as soon as it is so, false where it is not within ten seconds.
bool comes_true(const std::function<bool()>& condition) {
  for (int k = 0; k < 1000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return false;
}

double seconds_of(const std::function<void()>& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("a program's output and exit status are its own, and those of one that is killed are none") {
  CHECK(run_script("echo out; echo err >&2; exit 3").output == "out\nerr\n");
  CHECK(run_script("exit 3").status == 3);
  CHECK(run_script("kill -9 $$").status == -1);
  CHECK(run_script("exec >&- 2>&-; sleep 0.1; exit 4").status == 4);
  CHECK(run_script("cat").output.empty());  // nothing to read
  CHECK(run_program({"/no/such/program"}, seconds(20)).status != 0);
  CHECK(run_script("head -c 3000000 /dev/zero; exit 5").status == 5);
}

TEST_CASE("a program has a folder for temporary files, which goes with what is in it") {
  const TestCache cache;
  const TestVariable folder("TMPDIR", cache.folder.c_str());
  const std::string path = run_script("echo x > $TMPDIR/left; mkdir $TMPDIR/a; printf $TMPDIR").output;
  CHECK(path.starts_with(cache.folder + "/"));
  CHECK(fs::is_empty(cache.folder));
  run_script("echo x > $TMPDIR/left; sleep 100", milliseconds(100));
  CHECK(fs::is_empty(cache.folder));
}

TEST_CASE("where TMPDIR takes no folder, the one for temporary files is in the cache") {
  const TestCache cache;
  for (const std::string unusable : {"/proc", "/no/such/folder", "/dev/null"}) {
    CAPTURE(unusable);
    const TestVariable folder("TMPDIR", unusable.c_str());
    const std::string path = run_script("echo x > $TMPDIR/left && printf $TMPDIR").output;
    CHECK(path.starts_with(cache.folder + "/"));
    CHECK(fs::is_empty(cache.folder));
  }
}

TEST_CASE("a program that waits is stopped with all that it started, when its time has passed") {
  ProgramResult result;
  CHECK(seconds_of([&] { result = run_script("sleep 100 & echo $!; sleep 100; exit 0", milliseconds(300)); }) < 10);
  CHECK(result.timed_out);
  CHECK(result.status == -1);
  CHECK(comes_true([&] { return !runs(result.output); }));
}

TEST_CASE("what a program leaves running keeps nobody waiting, and is stopped") {
  ProgramResult result;
  CHECK(seconds_of([&] { result = run_script("sleep 100 & echo $!; exit 0"); }) < 10);
  CHECK(result.status == 0);
  CHECK(comes_true([&] { return !runs(result.output); }));
}

TEST_CASE("no child is left to wait for, by threads that run programs at once") {
  std::vector<std::thread> threads;
  std::vector<std::string> outputs(8);
  for (std::size_t k = 0; k < outputs.size(); ++k)
    threads.emplace_back([&outputs, k] { outputs[k] = run_script("printf " + std::to_string(k)).output; });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < outputs.size(); ++k) CHECK(outputs[k] == std::to_string(k));
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
}

TEST_CASE("a process that is killed takes its programs and what they half made with it") {
  for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
    const TestCache cache;
    const TestVariable folder("TMPDIR", cache.folder.c_str());
    const std::string made = cache.folder + "/.half-1.so", number = cache.folder + "/number";
    write_file(cache.folder + "/kept.so", "x");
    const pid_t process = fork();
    REQUIRE(process >= 0);
    if (process == 0) {
      ::signal(signal, SIG_DFL);
      run_script("echo x > $TMPDIR/left; echo x > " + made + "; echo x > " + cache.folder +
                     "/.half-1-ab.so.tmp; mkdir " + made + ".source; echo x > " + made +
                     ".source/x; sleep 100 & echo $! > " + number + ".new; mv " + number + ".new " + number +
                     "; sleep 100",
                 seconds(20), made);
      _exit(0);
    }
    REQUIRE(comes_true([&] { return fs::exists(number); }));
    kill(process, signal);
    REQUIRE(waitpid(process, nullptr, 0) == process);
    const std::string started = read_file(number);
    CHECK(comes_true([&] { return !runs(started); }));
    fs::remove(number);
    CHECK(comes_true([&] {  // all but kept.so
      return std::distance(fs::directory_iterator(cache.folder), fs::directory_iterator()) == 1;
    }));
    CHECK(fs::exists(cache.folder + "/kept.so"));
  }
}

TEST_CASE("a program that leaves its group ends in time all the same, and so does reading what others write on") {
  const auto begin = std::chrono::steady_clock::now();
  CHECK(run_program({"/usr/bin/setsid", "sleep", "100"}, seconds(1)).timed_out);
  const std::string writes = "setsid sh -c 'for i in $(seq 1000); do echo more; sleep 0.05; done' & exit 3";
  CHECK(run_program({"/bin/sh", "-c", writes}, seconds(50)).status == 3);
  CHECK(std::chrono::steady_clock::now() - begin < seconds(40));
}

TEST_CASE("a compiler that waits is named with a remedy") {
  const TestCache& cache = shared_cache();
  const std::string wrapper = cache.folder + "/waits";
  write_file(wrapper, "#!/bin/sh\nsleep 100\n");
  fs::permissions(wrapper, fs::perms::owner_all);
  const auto begin = std::chrono::steady_clock::now();
  for (int shader = 0; shader < 100; ++shader)  // asked once
    CHECK(message_of([&] { find_compiler(wrapper, seconds(1)); }) ==
          wrapper + " --version does not answer within 1 s; set CXX to a C++ compiler that works");
  CHECK(std::chrono::steady_clock::now() - begin < seconds(50));
  const ProgramResult late{-1, "", true};
  const std::string message = message_of([&] { require_made("object", {{wrapper}, ""}, late, "the shader"); });
  CHECK(message == wrapper +
                       " cannot compile the shader: it has not ended within 600 s; set CXX to a C++ compiler "
                       "that works");
}
