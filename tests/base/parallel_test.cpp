#include "base/parallel.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace twinshade;

TEST_CASE("each index is handed out once, worker numbers are in range and never shared") {
  for (int threads : {1, 2, 7}) {
    set_thread_count(threads);
    CHECK(thread_count() == threads);
    std::vector<std::atomic<int>> calls(1000);
    std::vector<std::atomic<int>> busy(std::size_t(threads) + 1);
    std::atomic<int> wrong{0};
    parallel_for(calls.size(), [&](std::size_t i, int worker) {
      if (worker < 0 || worker >= threads || busy[std::size_t(worker)]++ != 0) ++wrong;
      ++calls[i];
      --busy[std::size_t(worker)];
    });
    CHECK(wrong == 0);
    for (const auto& count : calls) CHECK(count == 1);
  }
  set_thread_count(0);
}

TEST_CASE("seven threads are seven, even on fewer processors") {
  set_thread_count(7);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  // Each call waits for the others, so that a busy machine cannot let a few threads do all the work; 20 s at most.
  parallel_for(7, [&](std::size_t, int) {
    for (int wait = 0; wait < 4000; ++wait) {
      {
        std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
        if (seen.size() == 7) return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  CHECK(seen.size() == 7);
  set_thread_count(0);
}

TEST_CASE("the first exception of a body comes back to the caller") {
  CHECK_THROWS_WITH_AS(parallel_for(100,
                                    [](std::size_t i, int) {
                                      if (i == 42) throw std::runtime_error("at 42");
                                    }),
                       "at 42", std::runtime_error);
  int calls = 0;
  parallel_for(0, [&](std::size_t, int) { ++calls; });
  CHECK(calls == 0);
}

TEST_CASE("calls within calls hand out each index once, and workers keep their numbers") {
  set_thread_count(4);
  std::vector<std::atomic<int>> calls(16 * 50);
  std::vector<std::atomic<int>> busy(4);
  std::atomic<int> wrong{0};
  for (int repeat = 0; repeat < 20; ++repeat)
    parallel_for(16, [&](std::size_t outer, int worker) {
      if (busy[std::size_t(worker)]++ != 0) ++wrong;
      parallel_for(50, [&](std::size_t inner, int) { ++calls[outer * 50 + inner]; });
      --busy[std::size_t(worker)];
    });
  CHECK(wrong == 0);
  for (const auto& count : calls) CHECK(count == 20);
  set_thread_count(0);
}
