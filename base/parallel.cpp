#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <memory>
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

#if TWINSHADE_USE_TBB
struct Arena {
  const int workers;
  // Without it TBB never runs more threads than there are processors, whatever the arena asks for.
  const oneapi::tbb::global_control control;
  oneapi::tbb::task_arena arena;
  explicit Arena(int count)
      : workers(count),
        control(oneapi::tbb::global_control::max_allowed_parallelism, std::size_t(count)),
        arena(count) {}

  void run(int tasks, const std::function<void(int)>& task) {
    arena.execute([&] {
      oneapi::tbb::task_group group;
      for (int i = 1; i < tasks; ++i) group.run([&task, i] { task(i); });
      task(0);
      group.wait();
    });
  }
};

// Whether this thread is within a parallel_for.
thread_local bool is_inside = false;

// Workers come to an arena that they were in before a tenth of a millisecond earlier than to a new one, so it is kept
// from call to call. A call within a call has its own: waiting in the same one, a thread would take up other calls of
// the outer body.
void run_tasks(int tasks, const std::function<void(int)>& task) {
  if (is_inside) {
    Arena(tasks).run(tasks, task);
    return;
  }
  thread_local std::unique_ptr<Arena> kept;
  if (!kept || kept->workers != thread_count()) {
    kept.reset();
    kept = std::make_unique<Arena>(thread_count());
  }
  kept->run(tasks, [&](int i) {
    is_inside = true;
    task(i);
    is_inside = false;
  });
}
#else
void run_tasks(int tasks, const std::function<void(int)>& task) {
  std::vector<std::thread> threads;
  for (int i = 1; i < tasks; ++i) threads.emplace_back([&task, i] { task(i); });
  task(0);
  for (std::thread& thread : threads) thread.join();
}
#endif

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
  if (workers <= 1)
    work.run(body, 0);
  else
    run_tasks(workers, [&](int worker) { work.run(body, worker); });
  if (work.error) std::rethrow_exception(work.error);
}

}  // namespace twinshade
