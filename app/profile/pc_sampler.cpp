#include "app/profile/pc_sampler.h"

#include <signal.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>

#include "base/error.h"

namespace twinshade {
namespace {

// What the signal handler may touch.
std::atomic<PcSample*> sample_buffer{nullptr};
std::atomic<std::size_t> sample_count{0};
std::size_t most_samples = 0;

struct Place {
  std::uintptr_t instruction = 0, frame = 0;  // frame: where the frame pointer points, if it is one
};

Place interrupted_at(const void* context) {
  const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
  return {std::uintptr_t(machine.gregs[REG_RIP]), std::uintptr_t(machine.gregs[REG_RBP])};
#elif defined(__aarch64__)
  return {std::uintptr_t(machine.pc), std::uintptr_t(machine.regs[29])};
#else
#error "where does this machine's ucontext_t keep the program counter?"
#endif
}

// The caller's frame pointer and the address that the call returns to lie side by side. Code without frame pointers has
// anything in that register: the kernel reads, which fails where we would crash.
bool go_to_caller(Place& place) {
  std::uintptr_t saved[2] = {0, 0};
  iovec here{saved, sizeof saved}, there{reinterpret_cast<void*>(place.frame), sizeof saved};
  if (place.frame == 0 || ::process_vm_readv(::getpid(), &here, 1, &there, 1, 0) != ssize_t(sizeof saved)) return false;
  if (saved[0] <= place.frame) saved[0] = 0;  // stacks grow down: no frame, or the last
  place = {saved[1], saved[0]};
  return place.instruction != 0;
}

void take_sample(int, siginfo_t*, void* context) {
  PcSample* const buffer = sample_buffer.load();
  if (!buffer) return;
  const std::size_t at = sample_count.fetch_add(1);
  if (at >= most_samples) return;
  const int error = errno;
  Place place = interrupted_at(context);
  PcSample sample{place.instruction};
  for (std::size_t depth = 1; depth < sample.size() && go_to_caller(place); ++depth) sample[depth] = place.instruction;
  buffer[at] = sample;
  errno = error;
}

void set_timer(long microseconds) {
  const itimerval timer{{0, microseconds}, {0, microseconds}};
  TWINSHADE_CHECK_EQ(::setitimer(ITIMER_PROF, &timer, nullptr), 0);
}

}  // namespace

PcSampler::PcSampler(std::size_t most) : samples_(most) {
  TWINSHADE_CHECK_EQ(sample_buffer.load() == nullptr, true);
  most_samples = most;
  sample_count = 0;
  sample_buffer = samples_.data();
  struct sigaction action {};
  action.sa_sigaction = take_sample;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  TWINSHADE_CHECK_EQ(::sigaction(SIGPROF, &action, nullptr), 0);
}

PcSampler::~PcSampler() {
  stop();
  sample_buffer = nullptr;  // a signal that is still under way finds none
}

void PcSampler::start() { set_timer(1000); }
void PcSampler::stop() { set_timer(0); }

const std::vector<PcSample>& PcSampler::samples() {
  samples_.resize(std::min(sample_count.load(), most_samples));
  sample_buffer = nullptr;
  return samples_;
}

}  // namespace twinshade
