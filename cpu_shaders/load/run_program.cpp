// Two children: the program, and a shell that watches over it. They are one process group, which the watcher leads, so
// that all of it can be killed at once. The watcher reads from a pipe that only this process can write to: the read
// ends with this process, even where that is killed. A group of its own gets no Ctrl-C, but this process does.
#include "cpu_shaders/load/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

#include "base/cache.h"
#include "base/error.h"

extern char** environ;

namespace twinshade {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t kMostOutput = std::size_t{1} << 20;

// $1: folder for temporary files. Limits are inherited: by the compiler proper, which the command starts.
constexpr const char* kRun =
    "ulimit -t 300 2>/dev/null; ulimit -v 4194304 2>/dev/null; [ -z \"$1\" ] || export TMPDIR=\"$1\"; shift; "
    "exec \"$@\"";
// $1: that folder, $2: how files and folders half made begin. Compilers end at TERM, some a moment later, and remove
// what they made; what ignores it is killed, and this shell with it.
constexpr const char* kWatch =
    "PATH=/usr/bin:/bin; trap '' HUP INT TERM; read -r _; kill -TERM 0; sleep 0.2; rm -rf -- \"$1\"; "
    "[ -z \"$2\" ] || rm -rf -- \"$2\"[.-]*; kill -KILL 0";

// A folder of its own: in TMPDIR, or in the cache where none can be made there, which not every compiler puts up with.
// Empty where there is no place for one: what is wrong with the cache is said by whoever uses it.
struct TemporaryFolder {
  std::string path;
  TemporaryFolder() {
    std::error_code code;
    const fs::path folder = fs::temp_directory_path(code);
    if (!code && make(folder / "twinshade-compiler-XXXXXX")) return;
    try {
      make(fs::path(cache_folder()) / ".twinshade-compiler-XXXXXX");
    } catch (const UserError&) {
    }
  }
  bool make(const fs::path& pattern) {
    path = pattern.string();
    if (!mkdtemp(path.data())) path.clear();
    return !path.empty();
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

struct Descriptor {
  int number = -1;
  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { reset(); }
  void reset() {
    if (number >= 0) close(number);
    number = -1;
  }
};

struct Pipe {
  Descriptor read_end, write_end;
  bool open() {  // closed in other threads' children
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return false;
    read_end.number = ends[0], write_end.number = ends[1];
    return true;
  }
};

// All of a group is killed, its leader waited for: until then no other group has its number.
struct Group {
  pid_t leader = -1;
  Group() = default;
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  ~Group() { end(); }
  void end() {
    if (leader < 0) return;
    kill(-leader, SIGKILL);
    while (waitpid(leader, nullptr, 0) < 0 && errno == EINTR) {
    }
    leader = -1;
  }
};

// group: 0 for one of its own. The system's error, or 0.
int start_shell(pid_t& child, const char* script, const std::vector<std::string>& words, pid_t group,
                const std::array<int, 3>& descriptors) {
  std::vector<char*> arguments;
  for (const char* word : {"/bin/sh", "-c", script, "sh"}) arguments.push_back(const_cast<char*>(word));
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int k = 0; k < 3; ++k) posix_spawn_file_actions_adddup2(&actions, descriptors[std::size_t(k)], k);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, group);
  const int error = posix_spawn(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

enum class Read { some, none, end };

// Waits for output, at most so long.
Read read_some(int descriptor, milliseconds time, std::string& output) {
  pollfd waited{descriptor, POLLIN, 0};
  if (poll(&waited, 1, int(time.count())) <= 0) return Read::none;
  char buffer[4096];
  const ssize_t count = read(descriptor, buffer, sizeof buffer);
  if (count > 0) output.append(buffer, std::min(std::size_t(count), kMostOutput - output.size()));
  return count > 0 ? Read::some : Read::end;
}

// Not by the end of its output alone: what a program leaves behind may keep that open, and a program may close it.
bool wait_for(pid_t child, int output_end, Clock::time_point deadline, int& status, std::string& output) {
  for (bool reads = true;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) return true;
    if (Clock::now() > deadline) return false;
    if (reads)
      reads = read_some(output_end, milliseconds(20), output) != Read::end;
    else
      std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& words, milliseconds time, const std::string& made) {
  ProgramResult result;
  const auto fails = [&](const char* what, int error) {
    result.started = false;
    result.output = std::string(what) + ": " + std::strerror(error);
    return result;
  };
  const TemporaryFolder folder;
  Pipe output, life;
  Descriptor nothing;
  nothing.number = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing.number < 0 || !output.open() || !life.open()) return fails("no pipe", errno);

  Group group;
  pid_t child = -1;
  const std::string begins = made.empty() ? "" : fs::path(made).replace_extension().string();
  if (const int error = start_shell(group.leader, kWatch, {folder.path, begins}, 0,
                                    {life.read_end.number, nothing.number, nothing.number}))
    return group.leader = -1, fails("cannot be started", error);
  std::vector<std::string> arguments{folder.path};
  arguments.insert(arguments.end(), words.begin(), words.end());
  if (const int error = start_shell(child, kRun, arguments, group.leader,
                                    {nothing.number, output.write_end.number, output.write_end.number}))
    return fails("cannot be started", error);
  output.write_end.reset();

  int status = 0;
  result.timed_out = !wait_for(child, output.read_end.number, Clock::now() + time, status, result.output);
  group.end();
  if (result.timed_out) {
    kill(child, SIGKILL);  // it may have left the group
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  } else if (WIFEXITED(status)) {
    result.status = WEXITSTATUS(status);
  }
  // The rest; what has left the group may hold the pipe, and write to it without end.
  const Clock::time_point end = Clock::now() + milliseconds(100);
  while (Clock::now() < end && read_some(output.read_end.number, milliseconds(20), result.output) == Read::some) {
  }
  return result;
}

}  // namespace twinshade
