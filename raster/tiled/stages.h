// Where a frame's time goes.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

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
  void reset() { total_ = {}; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
  StageMilliseconds total_{};
};

}  // namespace twinshade::tiled
