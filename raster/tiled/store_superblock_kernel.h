// From a tile's order of pixels to the frame's rows: a superblock of 16 x 16 pixels, rows of 16 at once and past the
// caches, since nobody reads the frame before it is done.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

// Whole cache lines are combined on their way to memory, without being read first. Where rows of the frame begin
// anywhere, lines would go there in parts: ordinary stores.
template <bool aligned, class V>
TWINSHADE_INLINE void stream(typename V::element* to, V value) {
  if constexpr (!aligned) {
    value.store(to);
  } else if constexpr (!V::whole) {
    stream<aligned>(to, value.lo);
    stream<aligned>(to + V::width / 2, value.hi);
  } else {
#if defined(__AVX2__)
    if constexpr (V::width == 8) return _mm256_stream_ps(reinterpret_cast<float*>(to), (__m256)value.v);
#endif
#if defined(__SSE2__)
    if constexpr (V::width == 4) return _mm_stream_ps(reinterpret_cast<float*>(to), (__m128)value.v);
#endif
    value.store(to);
  }
}

// Where pixel (x, y) of a superblock is in memory.
constexpr std::uint32_t in_superblock(std::uint32_t x, std::uint32_t y) {
  return (y / 4 * 4 + x / 4) * 16 + (y % 4 / 2 * 2 + x % 4 / 2) * 4 + y % 2 * 2 + x % 2;
}

// The lower and upper row of sixteen pixels, from the quads of four blocks.
template <class V>
struct Rows {
  V low[4], high[4];
  TWINSHADE_INLINE explicit Rows(const typename V::element* blocks) {
    for (int i = 0; i < 4; ++i) {
      const V left = V::load(blocks + 16 * i), right = V::load(blocks + 16 * i + 4);
      low[i].v = __builtin_shufflevector(left.v, right.v, 0, 1, 4, 5);
      high[i].v = __builtin_shufflevector(left.v, right.v, 2, 3, 6, 7);
    }
  }
  template <bool aligned>
  TWINSHADE_INLINE void stream_to(typename V::element* row, std::size_t width) const {
    for (int i = 0; i < 4; ++i) stream<aligned>(row + 4 * i, low[i]);
    for (int i = 0; i < 4; ++i) stream<aligned>(row + width + 4 * i, high[i]);
  }
};

// [m]: byte i is 1 where bit i of m is set.
inline constexpr std::uint32_t kCoverageBytes[16] = {
    0x00000000, 0x00000001, 0x00000100, 0x00000101, 0x00010000, 0x00010001, 0x00010100, 0x00010101,
    0x01000000, 0x01000001, 0x01000100, 0x01000101, 0x01010000, 0x01010001, 0x01010100, 0x01010101};

template <bool aligned>
TWINSHADE_INLINE void store_superblock_if(const StoreSuperblock& call) {
  using F4 = Simd<float, 4>;
  using U4 = Simd<std::uint32_t, 4>;
  using Pair = Simd<float, 8>;  // colours of (x, y) and (x + 1, y)
  const std::size_t width = call.width;
  for (std::uint32_t row = 0; row < kSuperblock; row += 2) {
    const std::size_t pixel = row * width, from = in_superblock(0, row);  // four blocks on, each 16 pixels further
    // Each line of memory is filled by stores that follow each other: processors combine few lines at a time.
    for (std::size_t up = 0; up < 2; ++up) {
      const float* const color = call.color + 4 * (from + 2 * up);
      float* const to = call.to_color + 4 * (pixel + up * width);
      for (std::size_t pair = 0; pair < 8; ++pair)
        stream<aligned>(to + 8 * pair, Pair::load(color + 4 * (pair / 2 * 16 + pair % 2 * 4)));
    }
    Rows<F4>(call.depth + from).template stream_to<aligned>(call.to_depth + pixel, width);
    if (!call.to_primitive_id) continue;
    const Rows<U4> id(call.primitive_id + from);
    id.template stream_to<aligned>(call.to_primitive_id + pixel, width);
    for (std::size_t block = 0; block < 4; ++block) {
      const std::uint32_t bytes[2] = {kCoverageBytes[(id.low[block] != U4(call.no_primitive)).bits()],
                                      kCoverageBytes[(id.high[block] != U4(call.no_primitive)).bits()]};
      std::memcpy(call.to_coverage + pixel + 4 * block, &bytes[0], 4);
      std::memcpy(call.to_coverage + pixel + 4 * block + width, &bytes[1], 4);
    }
  }
}

inline void store_superblock(const StoreSuperblock& call) {
  return call.aligned ? store_superblock_if<true>(call) : store_superblock_if<false>(call);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
