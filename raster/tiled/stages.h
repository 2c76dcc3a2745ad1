// Where a frame's time goes.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace twinshade::tiled {

enum class Stage : std::size_t { vertex, bin, raster, interpolate, shade, store };
inline constexpr std::size_t kStageCount = 6;
inline constexpr const char* kStageNames[kStageCount] = {"vertex", "bin", "raster", "interpolate", "shade", "store"};

using StageMilliseconds = std::array<double, kStageCount>;

// One thread's clock: lap() adds the time since the last lap or start to a stage.
class StageClock {
 public:
  void start() { last_ = Clock::now(); }
  void lap(Stage stage) {
    const Clock::time_point now = Clock::now();
    total_[std::size_t(stage)] += std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
  }
  const StageMilliseconds& total() const { return total_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
  StageMilliseconds total_{};
};

// The same, in units of its own, for laps of a microsecond: where processors count time themselves, asking them takes
// half as long as asking for nanoseconds.
class StageTicks {
 public:
  void start() { last_ = now(); }
  void lap(Stage stage) {
    const std::uint64_t at = now();
    if (at > last_) total_[std::size_t(stage)] += at - last_;  // not so where a thread has moved to another processor
    last_ = at;
  }
  const std::array<std::uint64_t, kStageCount>& total() const { return total_; }
  void reset() { total_ = {}; }

 private:
  static std::uint64_t now() {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return std::uint64_t(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
  }
  std::uint64_t last_ = 0;
  std::array<std::uint64_t, kStageCount> total_{};
};

}  // namespace twinshade::tiled
