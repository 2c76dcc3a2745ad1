#include "raster/gl/worker_process.h"

#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "raster/gl/protocol.h"
#include "raster/gl/worker_environment.h"

namespace twinshade::gl {
namespace {

std::atomic<bool> entry_exists{false};

std::string worker_program(const std::string& backend) {
  if (const char* path = std::getenv("TWINSHADE_WORKER")) return path;
  if (!worker_entry_exists())
    throw BackendError(
        backend +
        ": this program cannot be its own worker: call run_gl_worker_if_asked first thing in main(), or name a "
        "program that does in the environment variable TWINSHADE_WORKER");
  return "/proc/self/exe";
}

class SpawnActions {
 public:
  SpawnActions() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnActions() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  void give(int fd, int as) { posix_spawn_file_actions_adddup2(&actions_, fd, as); }
  void no_input() { posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", 0, 0); }
  int spawn(pid_t& pid, const std::string& path, const std::vector<std::string>& arguments,
            const std::vector<std::string>& environment) {
    return posix_spawn(&pid, path.c_str(), &actions_, &attributes_, pointers(arguments).data(),
                       pointers(environment).data());
  }

 private:
  static std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
    result.push_back(nullptr);
    return result;
  }
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

Channel::Clock::time_point deadline_after(double seconds) {
  constexpr double kForever = 1e9;  // more nanoseconds than a time point holds would be a deadline in the past
  return Channel::Clock::now() + std::chrono::duration_cast<Channel::Clock::duration>(
                                     std::chrono::duration<double>(std::min(seconds, kForever)));
}

}  // namespace

void note_worker_entry() { entry_exists = true; }
bool worker_entry_exists() { return entry_exists; }

const char* backend_name(GlBackend backend) {
  switch (backend) {
    case GlBackend::egl:
      return "egl";
    case GlBackend::osmesa:
      return "osmesa";
    case GlBackend::softpipe:
      return "softpipe";
    case GlBackend::gpu:
      return "gpu";
  }
  return "gl";
}

WorkerProcess::WorkerProcess(GlBackend backend, GlEnvironment environment)
    : backend_(backend), environment_(std::move(environment)) {}

WorkerProcess::~WorkerProcess() { stop(); }

void WorkerProcess::start(double time_limit_seconds) {
  const std::string name = backend_name(backend_);
  if (std::getenv(kInsideWorker) != nullptr) throw BackendError(name + ": a worker cannot start another worker");
  const std::string program = worker_program(name);
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw BackendError(name + ": cannot make a socket: " + std::strerror(errno));
  FileDescriptor ours(ends[0]), theirs(ends[1]);
  // Its own file, which Mesa's messages grow; only its end is ever read.
  try {
    output_ = SharedMemory::create(1);
  } catch (const std::system_error& error) {
    throw BackendError(name + ": " + error.what());
  }

  SpawnActions actions;
  actions.no_input();
  actions.give(output_.fd(), 1);
  actions.give(output_.fd(), 2);
  actions.give(theirs.get(), kWorkerSocket);
  const auto deadline = deadline_after(time_limit_seconds);
  const int error =
      actions.spawn(pid_, program, {"twinshade", kWorkerArgument, name}, worker_environment(backend_, environment_));
  if (error != 0) {
    pid_ = -1;
    throw BackendError(name + ": cannot start the worker " + program + ": " + std::strerror(error));
  }
  channel_.emplace(std::move(ours));
  theirs.reset();

  // Its first message says whether there is a context to draw with.
  DrawReply hello;
  const std::string bytes = receive(deadline, time_limit_seconds);
  WireReader(bytes).get(hello);
  if (hello.outcome != Outcome::ok) {
    stop();
    throw BackendError(name + ": " + hello.text);
  }
}

std::string WorkerProcess::exchange(const std::string& request, const std::vector<int>& descriptors,
                                    double time_limit_seconds) {
  const auto deadline = deadline_after(time_limit_seconds);
  const ChannelState sent = channel_->send(request, descriptors, deadline);
  if (sent != ChannelState::ok) died(sent, time_limit_seconds);
  return receive(deadline, time_limit_seconds);
}

std::string WorkerProcess::receive(Channel::Clock::time_point deadline, double time_limit_seconds) {
  Message message;
  const ChannelState state = channel_->receive(message, deadline);
  if (state != ChannelState::ok) died(state, time_limit_seconds);
  return std::move(message.bytes);
}

void WorkerProcess::died(ChannelState state, double time_limit_seconds) {
  const std::string name = backend_name(backend_);
  if (state == ChannelState::timed_out) {
    stop();
    throw BackendError(name + ": no answer within " + seconds_text(time_limit_seconds) + ", so the worker was ended");
  }
  // A closed socket means that the process is ending: its status follows within moments, or it is made to.
  int status = 0;
  for (int attempt = 0; waitpid(pid_, &status, attempt < 100 ? WNOHANG : 0) == 0; ++attempt) {
    if (attempt == 99) kill(pid_, SIGKILL);
    usleep(20000);
  }
  pid_ = -1;
  const std::string output = last_output();
  stop();
  std::string reason = "the worker ended by itself";
  if (WIFSIGNALED(status)) {
    const char* abbreviation = sigabbrev_np(WTERMSIG(status));
    reason = std::string("the driver crashed (SIG") + (abbreviation ? abbreviation : "?") + ", " +
             strsignal(WTERMSIG(status)) + ")";
  } else if (WIFEXITED(status)) {
    reason += " with exit code " + std::to_string(WEXITSTATUS(status));
  }
  throw BackendError(name + ": " + reason + (output.empty() ? "" : "; it last printed: " + output));
}

std::string WorkerProcess::last_output() const {
  struct stat status {};
  if (output_.fd() < 0 || fstat(output_.fd(), &status) != 0) return "";
  char tail[512];
  const off_t from = std::max<off_t>(0, status.st_size - off_t(sizeof tail));
  const ssize_t count = pread(output_.fd(), tail, sizeof tail, from);
  std::string text(tail, std::size_t(std::max<ssize_t>(count, 0)));
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.pop_back();
  const std::size_t line = text.find_last_of(std::string("\n\0", 2));
  return line == std::string::npos ? text : text.substr(line + 1);
}

void WorkerProcess::stop() {
  channel_.reset();
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  output_ = SharedMemory();
}

std::vector<std::pair<std::string, std::string>> WorkerProcess::settings() const {
  return worker_settings(backend_, environment_);
}

}  // namespace twinshade::gl
