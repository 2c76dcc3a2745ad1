// The handler may only call what is async-signal-safe and takes no lock: files lie in a list whose slots are used again
// and never freed. Whoever empties a slot has its file: the handler keeps it, since the process ends.
#include "base/removed_on_signal.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace twinshade {

struct RemovedOnSignal::File {
  pid_t owner;
  std::string path;
};

struct RemovedOnSignal::Slot {
  std::atomic<File*> file{nullptr};
  Slot* next = nullptr;
  static std::atomic<Slot*> first;
};

std::atomic<RemovedOnSignal::Slot*> RemovedOnSignal::Slot::first{nullptr};
static_assert(std::atomic<void*>::is_always_lock_free);

namespace {
std::atomic<bool> ending{false};  // a handler has begun: nobody begins or finishes a file any more

[[noreturn]] void wait_for_end() {
  for (;;) ::pause();
}
}  // namespace

void RemovedOnSignal::remove_all(int signal) {
  ending = true;
  for (Slot* slot = Slot::first.load(); slot; slot = slot->next)
    if (const File* file = slot->file.exchange(nullptr); file && file->owner == ::getpid())
      ::unlink(file->path.c_str());
  ::raise(signal);  // SA_RESETHAND: by default now. Delivered on return, when it is not blocked any more
}

void RemovedOnSignal::install() {
  struct sigaction ours = {};
  ours.sa_handler = remove_all;
  ours.sa_flags = static_cast<int>(SA_RESETHAND);
  constexpr int kSignals[] = {SIGHUP, SIGINT, SIGTERM};
  sigemptyset(&ours.sa_mask);
  for (const int signal : kSignals) sigaddset(&ours.sa_mask, signal);
  for (const int signal : kSignals) {
    struct sigaction now = {};
    const bool by_default =
        ::sigaction(signal, nullptr, &now) == 0 && !(now.sa_flags & SA_SIGINFO) && now.sa_handler == SIG_DFL;
    if (by_default) ::sigaction(signal, &ours, nullptr);
  }
}

RemovedOnSignal::Slot& RemovedOnSignal::take_slot(File* file) {
  for (Slot* slot = Slot::first.load(); slot; slot = slot->next) {
    File* empty = nullptr;
    if (slot->file.compare_exchange_strong(empty, file)) return *slot;
  }
  Slot* slot = new Slot;
  slot->file = file;
  slot->next = Slot::first.load();
  while (!Slot::first.compare_exchange_weak(slot->next, slot)) {
  }
  return *slot;
}

RemovedOnSignal::RemovedOnSignal(const std::string& path)
    : file_(new File{::getpid(), path}), slot_((install(), take_slot(file_))) {
  if (ending) wait_for_end();
}

RemovedOnSignal::~RemovedOnSignal() {
  File* ours = file_;
  if (!slot_.file.compare_exchange_strong(ours, nullptr)) wait_for_end();  // removed, and the process is ending
  delete file_;
}

}  // namespace twinshade
