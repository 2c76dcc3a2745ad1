// How far a long computation is, on stderr, where that is a terminal: rate and time left.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace twinshade {

class Progress {
 public:
  // `what`: "bake: direct light"; `unit`: what total counts, "rays".
  Progress(std::string what, std::string unit, std::uint64_t total, bool wanted);
  ~Progress();  // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // By any thread.
  void add(std::uint64_t count);

 private:
  void show(std::uint64_t done);

  const std::string what_, unit_;
  const std::uint64_t total_;
  const bool shown_;
  const std::chrono::steady_clock::time_point start_;
  std::atomic<std::uint64_t> done_{0};
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace twinshade
