// Where this process spends its time: addresses of instructions, and of what called them, taken at regular intervals of
// processor time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace twinshade {

// The instruction first, then those that calls return to, as far as code has frame pointers; 0 where there are no more.
using PcSample = std::array<std::uintptr_t, 6>;

// One at a time. Signals come with the kernel's ticks, 100 to 1000 a second, for all threads together.
class PcSampler {
 public:
  explicit PcSampler(std::size_t most);  // further samples are dropped
  ~PcSampler();
  PcSampler(const PcSampler&) = delete;
  PcSampler& operator=(const PcSampler&) = delete;

  void start();
  void stop();
  // While stopped.
  const std::vector<PcSample>& samples();

 private:
  std::vector<PcSample> samples_;
};

}  // namespace twinshade
