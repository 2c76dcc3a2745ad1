// The parent's side of a worker: starting it with its own environment, talking to it within a time limit, saying why it
// died.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "raster/gl/channel.h"
#include "raster/gl/gl_renderer.h"

namespace twinshade::gl {

const char* backend_name(GlBackend backend);

// First argument of a worker; the second is the name of its backend.
inline constexpr const char* kWorkerArgument = "--twinshade-gl-worker";
// Descriptor of a worker's end of the socket.
inline constexpr int kWorkerSocket = 3;
// Set in a worker's environment, so that no worker ever starts another.
inline constexpr const char* kInsideWorker = "TWINSHADE_INSIDE_WORKER";

class WorkerProcess {
 public:
  WorkerProcess(GlBackend backend, GlEnvironment environment);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  bool running() const { return channel_.has_value(); }
  // Starts it and waits until it has a context. BackendError where that fails.
  void start(double time_limit_seconds);
  // Sends a request, returns the answer. BackendError, and no longer running, where the worker crashes or exceeds the
  // limit.
  std::string exchange(const std::string& request, const std::vector<int>& descriptors, double time_limit_seconds);
  void stop();

  std::vector<std::pair<std::string, std::string>> settings() const;  // the variables that differ from the defaults

 private:
  std::string receive(Channel::Clock::time_point deadline, double time_limit_seconds);
  [[noreturn]] void died(ChannelState state, double time_limit_seconds);
  std::string last_output() const;

  GlBackend backend_;
  GlEnvironment environment_;
  pid_t pid_ = -1;
  std::optional<Channel> channel_;
  SharedMemory output_;  // what the worker and its driver print
};

// For run_gl_worker_if_asked and the check that main() calls it.
void note_worker_entry();
bool worker_entry_exists();

}  // namespace twinshade::gl
