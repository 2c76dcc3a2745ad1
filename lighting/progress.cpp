#include "lighting/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace twinshade {

Progress::Progress(std::string what, std::string unit, std::uint64_t total, bool wanted)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      shown_(wanted && isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::add(std::uint64_t count) {
  const std::uint64_t done = done_.fetch_add(count, std::memory_order_relaxed) + count;
  if (!shown_) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  const auto now = std::chrono::steady_clock::now();
  if (!lock.owns_lock() || now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  show(done);
}

void Progress::show(std::uint64_t done) {
  const double seconds = std::chrono::duration<double>(last_ - start_).count();
  const double rate = double(done) / seconds;
  const double left = double(total_ - done) / rate;
  const std::string line = fmt::format("\r{}: {:.0f} %, {:.2f} M {}/s, {:.0f} s left\x1b[K", what_,
                                       100.0 * double(done) / double(total_), rate * 1e-6, unit_, left);
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace twinshade
