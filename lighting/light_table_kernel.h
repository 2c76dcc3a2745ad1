// The loops over a table's texels, built once for each instruction set: every sum has the same order in all of them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace twinshade::light_table {

inline constexpr std::size_t kBlock = 16;  // texels

// How the texel numbers of a block run: next to each other, upwards or downwards, or anyhow.
enum Layout : std::uint8_t { kUpperRuns = 1, kLowerRunsUp = 2, kLowerRunsDown = 4 };

struct Call {
  const float* products;  // [row * 3 + c][even + odd]
  std::size_t rows, even, odd;
  const float* cosine;         // [even + odd][blocks * kBlock]
  const std::uint32_t* upper;  // [blocks * kBlock]: texels of the sums
  const std::uint32_t* lower;  // of the differences; written first, where both are the same texel
  const std::uint8_t* layout;  // [blocks]
  std::size_t blocks, texels;
  float* values;  // [row * 3 + c][texels]
};

struct Kernel {
  void (*fill)(const Call&);
  void (*blend)(const float* a, const float* b, float part, float* out, std::size_t count);
};

Kernel kernel_of_baseline();
#if defined(__x86_64__)
Kernel kernel_of_avx2();
Kernel kernel_of_avx512();
#endif

}  // namespace twinshade::light_table
