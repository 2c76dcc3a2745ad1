// The farthest depth of each block of a tile: what is farther still is hidden there (one level of Greene, Kass and
// Miller, Hierarchical Z-buffer visibility, SIGGRAPH 1993).
#pragma once

#include <array>
#include <utility>

#include "raster/tiled/block_depth_kernel.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

// Lanes first .. first + count - 1 of those of a and then b.
template <int first, int count, class V>
TWINSHADE_INLINE auto some_lanes(const V& a, const V& b) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(a, b, (first + k)...);
  }
  (std::make_integer_sequence<int, count>());
}

template <int W>
TWINSHADE_INLINE std::int32_t greatest_lane(const Simd<std::int32_t, W>& x) {
  using I = Simd<std::int32_t, W>;
  if constexpr (!I::whole) {
    return greatest_lane(lanes_max(x.lo, x.hi));
  } else if constexpr (W > 4) {
    Simd<std::int32_t, W / 2> low, high;
    low.v = some_lanes<0, W / 2>(x.v, x.v);
    high.v = some_lanes<W / 2, W / 2>(x.v, x.v);
    return greatest_lane(lanes_max(low, high));
  } else {
    I y = x, other;
    other.v = some_lanes<2, 4>(y.v, y.v);
    y = lanes_max(y, other);
    other.v = some_lanes<1, 4>(y.v, y.v);
    return lanes_max(y, other).lane(0);
  }
}

// CoverTile::farthest. Columns and rows: of blocks, from the tile's first one.
class FarthestDepths {
 public:
  TWINSHADE_INLINE explicit FarthestDepths(const CoverTile& tile) : depths_(tile.farthest), blocks_(tile.size / 4) {}

  // Bit k: all of block k, of the window that begins here, is nearer than `depth`.
  TWINSHADE_INLINE std::uint32_t nearer_than(float depth, std::uint32_t column, std::uint32_t row) const {
    return (rows<16>(at(column, row)) < BlockInts(number::bits<std::int32_t>(depth))).bits();
  }
  // Whether all of the tile is.
  TWINSHADE_INLINE bool all_nearer_than(float depth) const {
    BlockInts farthest(0);
    for (std::uint32_t row = 0; row < blocks_; row += 4)
      for (std::uint32_t column = 0; column < blocks_; column += 4)
        farthest = lanes_max(farthest, rows<16>(at(column, row)));
    return greatest_lane(farthest) < number::bits<std::int32_t>(depth);
  }

  // depths: their bits, of the pixels of block k of the window that begins here.
  TWINSHADE_INLINE void set(std::uint32_t column, std::uint32_t row, std::size_t k, const BlockInts& depths) const {
    at(column, row)[kPlaces[k]] = number::bits<float>(greatest_lane(depths));
  }

 private:
  TWINSHADE_INLINE float* at(std::uint32_t column, std::uint32_t row) const {
    return depths_ + std::size_t{row} * kFarthestStride + column;
  }
  // Of W / 4 rows, each of four blocks.
  template <int W>
  static TWINSHADE_INLINE Simd<std::int32_t, W> rows(const float* from) {
    using I = Simd<std::int32_t, W>;
    if constexpr (W == 4) {
      return Simd<float, W>::load(from).template as<std::int32_t>();
    } else {
      const auto low = rows<W / 2>(from), high = rows<W / 2>(from + W / 8 * kFarthestStride);
      I all;
      if constexpr (I::whole)
        all.v = some_lanes<0, W>(low.v, high.v);
      else
        all.lo = low, all.hi = high;
      return all;
    }
  }

  // Of a window's blocks, from its first one.
  static constexpr auto kPlaces = [] {
    std::array<std::uint32_t, 16> places{};
    for (std::uint32_t k = 0; k < 16; ++k) places[k] = k / 4 * kFarthestStride + k % 4;
    return places;
  }();
  // From +0 to 1: they are compared by their bits. What they are compared with may be negative.
  float* const depths_;
  const std::uint32_t blocks_;  // across the tile
};

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
