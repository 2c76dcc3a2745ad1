#include "run_twinshade.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

extern char** environ;

namespace twinshade {
namespace {

std::string read_whole(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// until: see run_twinshade_until; empty: the run is waited for. stdout_to: an open descriptor; -1: Run's.
Run run(const std::vector<std::string>& arguments, const std::function<bool()>& until, int stdout_to = -1) {
  std::filesystem::create_directories(TWINSHADE_TEST_CACHE);
  ::setenv("TWINSHADE_CACHE", TWINSHADE_TEST_CACHE, 1);
  const Folder folder;
  const std::string out = folder / "out", err = folder / "err";

  std::string program = TWINSHADE_BINARY;
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& copy : copies) argv.push_back(copy.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (stdout_to >= 0)
    posix_spawn_file_actions_adddup2(&actions, stdout_to, STDOUT_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  REQUIRE_MESSAGE(failed == 0, "cannot start " << program);

  int status = 0;
  bool ended = false;
  while (until && !ended && !until()) {
    ended = ::waitpid(child, &status, WNOHANG) == child;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (until && !ended) ::kill(child, SIGTERM);
  if (!ended) ::waitpid(child, &status, 0);
  Run run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = read_whole(out);
  run.err = read_whole(err);
  return run;
}

}  // namespace

Run run_twinshade(const std::vector<std::string>& arguments) { return run(arguments, nullptr); }

Run run_twinshade_unread(const std::vector<std::string>& arguments) {
  int ends[2];
  REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
  ::close(ends[0]);
  const Run ended = run(arguments, nullptr, ends[1]);
  ::close(ends[1]);
  return ended;
}

Run run_twinshade_until(const std::vector<std::string>& arguments, const std::function<bool()>& until) {
  return run(arguments, until);
}

Folder::Folder() {
  static std::atomic<int> serial{0};
  path_ = std::filesystem::temp_directory_path() /
          ("twinshade_app_test_" + std::to_string(::getpid()) + "_" + std::to_string(serial++));
  std::filesystem::create_directories(path_);
}

Folder::~Folder() {
  std::error_code code;
  std::filesystem::permissions(path_, std::filesystem::perms::owner_all, code);
  std::filesystem::remove_all(path_, code);
}

std::string Folder::file(const std::string& name, const std::string& content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
  return *this / name;
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> small_quad(std::vector<std::string> before, const std::vector<std::string>& after) {
  for (const char* argument : {"quad", "--size", "64x40", "--lightmap", "16", "--rays", "16"})
    before.emplace_back(argument);
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

std::string why_missing(const std::string& backend) {
  static const nlohmann::json backends = run_twinshade({"list", "backends", "--json", "-"}).json()["backends"];
  for (const auto& entry : backends)
    if (entry["name"] == backend) return entry["works"].get<bool>() ? "" : entry["reason"].get<std::string>();
  return "not listed";
}

std::vector<std::string> opengl_backends() {
  std::vector<std::string> working;
  for (const std::string backend : {"egl", "osmesa"}) {
    const std::string reason = why_missing(backend);
    if (reason.empty())
      working.push_back(backend);
    else
      MESSAGE("not tested on " << backend << ": " << reason);
  }
  return working;
}

}  // namespace twinshade
