// Threads, behind one door: oneTBB, or std::thread where TBB cannot go (thread sanitizer, AArch64 under qemu).
#pragma once

#include <cstddef>
#include <functional>

namespace twinshade {

// Number of threads that parallel_for uses from now on. 0 = one per processor that this process may run on. More threads
// than processors is allowed and really makes that many. Not to be called while a parallel_for runs.
void set_thread_count(int count);
int thread_count();

// Calls body(i, worker) once for each i in [0, count), in no particular order; worker in [0, thread_count()) is constant
// within a call and never in use by two calls at a time, so it can index scratch memory. Calls are handed out one i at a
// time (make each worth >= 10 us). The first exception thrown by a body is rethrown here after the others have stopped.
// Results must not depend on order or worker: that is the caller's contract.
void parallel_for(std::size_t count, const std::function<void(std::size_t i, int worker)>& body);

}  // namespace twinshade
