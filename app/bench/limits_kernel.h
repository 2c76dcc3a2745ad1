// What one thread can do at most, as loops that the compiler cannot shorten; built once for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace twinshade::bench {

struct LimitsKernel {
  // Multiplies and adds floats, as many of either, in registers and independent of each other; never fused. Returns how
  // many operations that were.
  std::uint64_t (*multiply_add)(std::uint64_t turns);
  // Reads all of a buffer `turns` times by whole registers. bytes: a multiple of 1024, 64-byte aligned. Returns the
  // bytes read.
  std::uint64_t (*load)(const std::byte* buffer, std::size_t bytes, std::uint64_t turns);
};

LimitsKernel limits_kernel_of_baseline();
#if defined(__x86_64__)
LimitsKernel limits_kernel_of_avx2();
LimitsKernel limits_kernel_of_avx512();
#endif

}  // namespace twinshade::bench
