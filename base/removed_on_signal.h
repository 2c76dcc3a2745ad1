// Files half made that do not outlive the process where a signal ends it.
#pragma once

#include <string>

namespace twinshade {

// While it lives, a file of this path, there or not, is removed when SIGHUP, SIGINT or SIGTERM ends the process, which
// ends by that signal all the same. Signals that are ignored or handled stay so. Of a process that is forked meanwhile
// it is not: that one's end removes nothing. From any thread.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  struct File;
  struct Slot;
  static void remove_all(int signal);
  static void install();
  static Slot& take_slot(File* file);

  File* file_;
  Slot& slot_;
};

}  // namespace twinshade
