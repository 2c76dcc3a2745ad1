// A process that a signal ends while it writes a file leaves nothing beside that file.
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "base/file.h"
#include "base/removed_on_signal.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

struct Folder {
  std::string path = fs::temp_directory_path() / ("twinshade_signal_test_" + std::to_string(::getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

// Of a process that writes a file without end, once its temporary is there and it gets the signal.
int status_by(int signal, const std::string& path, const Folder& folder) {
  const std::size_t before = folder.files();
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(signal, SIG_DFL);  // shells start what runs in the background without SIGINT
    write_file_with(path, [](const std::string& temporary) {
      std::ofstream(temporary) << "half";
      for (;;) ::pause();
    });
    ::_exit(0);
  }
  for (int tries = 0; tries < 5000 && folder.files() == before; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(folder.files() == before + 1);
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a signal that ends the process while it writes leaves no temporary, and ends it by that signal") {
  const Folder folder;
  const std::string path = folder.path + "/out.json";
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const int status = status_by(signal, path, folder);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
    CHECK(folder.files() == 0);
  }
  write_file(path, "whole");
  CHECK(WTERMSIG(status_by(SIGTERM, path, folder)) == SIGTERM);
  CHECK(read_file(path) == "whole");
  CHECK(folder.files() == 1);
}

TEST_CASE("the end of a process that is forked meanwhile removes nothing of its parent's") {
  const Folder folder;
  const std::string path = folder.path + "/half";
  std::ofstream(path) << "half";
  const pid_t parent = ::fork();
  if (parent == 0) {
    ::signal(SIGTERM, SIG_DFL);
    const RemovedOnSignal removed(path);
    const pid_t child = ::fork();
    if (child == 0)
      for (;;) ::pause();
    ::kill(child, SIGTERM);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::_exit(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM && fs::exists(path) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(parent, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("signals that are ignored stay ignored") {
  const Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGINT, SIG_IGN);
    write_file(folder.path + "/out", "whole");
    ::raise(SIGINT);
    ::_exit(7);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

}  // namespace twinshade
