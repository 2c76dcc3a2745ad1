#include "base/parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/processors.h"

#if TWINSHADE_USE_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#endif

#include <sched.h>

namespace twinshade {
namespace {

int& requested() {
  static int count = processor_count();
  return count;
}

// Shared by the workers of one parallel_for: the next index to hand out and the first exception.
struct Work {
  explicit Work(std::size_t n) : count(n) {}
  const std::size_t count;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;

  void run(const std::function<void(std::size_t, int)>& body, int worker) {
    try {
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) body(i, worker);
    } catch (...) {
      next.store(count, std::memory_order_relaxed);
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  }
};

}  // namespace

int processor_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  const unsigned count = std::thread::hardware_concurrency();
  return count == 0 ? 1 : int(count);
}

void set_thread_count(int count) {
  if (count < 0 || count > 1024) throw UserError("threads: " + std::to_string(count) + " is not within 0 to 1024");
  requested() = count == 0 ? processor_count() : count;
}

int thread_count() { return requested(); }

void parallel_for(std::size_t count, const std::function<void(std::size_t, int)>& body) {
  Work work(count);
  const int workers = int(std::min<std::size_t>(std::size_t(thread_count()), count));
  if (workers <= 1) {
    work.run(body, 0);
  } else {
#if TWINSHADE_USE_TBB
    // Without global_control TBB never runs more threads than there are processors, whatever the arena asks for.
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                              std::size_t(workers));
    oneapi::tbb::task_arena arena(workers);
    arena.execute([&] {
      oneapi::tbb::task_group group;
      for (int worker = 1; worker < workers; ++worker) group.run([&, worker] { work.run(body, worker); });
      work.run(body, 0);
      group.wait();
    });
#else
    std::vector<std::thread> threads;
    for (int worker = 1; worker < workers; ++worker) threads.emplace_back([&, worker] { work.run(body, worker); });
    work.run(body, 0);
    for (std::thread& thread : threads) thread.join();
#endif
  }
  if (work.error) std::rethrow_exception(work.error);
}

}  // namespace twinshade
