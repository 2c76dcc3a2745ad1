#include "app/bench/limits.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "app/bench/limits_kernel.h"
#include "app/report/quartiles.h"
#include "base/parallel.h"
#include "raster/tiled/aligned.h"

namespace twinshade::bench {
namespace {

constexpr double kSliceSeconds = 2e-4;  // less than a time slice of the system: few are interrupted
constexpr std::size_t kSlices = 100;    // of each thread

LimitsKernel kernel_of(Isa isa) {
#if defined(__x86_64__)
  if (isa == Isa::avx512) return limits_kernel_of_avx512();
  if (isa == Isa::avx2) return limits_kernel_of_avx2();
#endif
  (void)isa;
  return limits_kernel_of_baseline();
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// work(turns, worker) returns how much it did. The rate of all threads together, a second: what a thread reaches while
// the others run, so many times. The upper quartile of short slices counts: most were not interrupted by other
// processes.
template <class Work>
double rate(const Work& work) {
  std::uint64_t turns = 1;
  for (double seconds = 0; seconds < kSliceSeconds; turns *= 2) {
    const auto start = std::chrono::steady_clock::now();
    work(turns, 0);
    seconds = seconds_since(start);
  }
  std::vector<double> rates(kSlices * std::size_t(thread_count()));
  parallel_for(rates.size(), [&](std::size_t slice, int worker) {
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t done = work(turns, worker);
    rates[slice] = double(done) / seconds_since(start);
  });
  return quartiles(rates).q3 * thread_count();
}

// sysconf's answer, or `otherwise` where it has none.
std::size_t cache_size(int name, std::size_t otherwise) {
  const long size = sysconf(name);
  return size > 0 ? std::size_t(size) : otherwise;
}

double load_rate(const LimitsKernel& kernel, std::size_t bytes) {
  bytes = bytes / 1024 * 1024;
  std::vector<tiled::AlignedArray<float>> buffers;
  for (int i = 0; i < thread_count(); ++i) {
    buffers.emplace_back(bytes / sizeof(float));
    std::fill_n(buffers.back().data(), bytes / sizeof(float), 1.0f);
  }
  return rate([&](std::uint64_t turns, int worker) {
    return kernel.load(reinterpret_cast<const std::byte*>(buffers[std::size_t(worker)].data()), bytes, turns);
  });
}

}  // namespace

Limits measure_limits(Isa isa) {
  const LimitsKernel kernel = kernel_of(isa);
  const std::size_t l1 = cache_size(_SC_LEVEL1_DCACHE_SIZE, 32 << 10),
                    l2 = cache_size(_SC_LEVEL2_CACHE_SIZE, 512 << 10);
  Limits limits;
  limits.isa = isa;
  limits.flops = rate([&](std::uint64_t turns, int) { return kernel.multiply_add(turns * 256); });
  limits.l1_bytes = load_rate(kernel, l1 / 2);
  limits.l2_bytes = load_rate(kernel, std::max(l2 / 2, 4 * l1));
  return limits;
}

Json json_of(const std::vector<Limits>& limits) {
  Json json = Json::object();
  for (const Limits& of : limits)
    json[isa_name(of.isa)] = {
        {"flops_per_second", of.flops}, {"l1_bytes_per_second", of.l1_bytes}, {"l2_bytes_per_second", of.l2_bytes}};
  return json;
}

std::string text_of(const std::vector<Limits>& limits) {
  std::string text;
  for (const Limits& of : limits)
    text += fmt::format(
        "{}, {} threads: {:.0f} GFLOP/s of separate multiply and add; {:.0f} GB/s from L1, {:.0f} from L2\n",
        isa_name(of.isa), thread_count(), of.flops * 1e-9, of.l1_bytes * 1e-9, of.l2_bytes * 1e-9);
  return text;
}

}  // namespace twinshade::bench
