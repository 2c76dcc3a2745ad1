// Which pixels a triangle covers and how deep it is there. Hierarchy: windows of 16 x 16 pixels in 64-bit arithmetic,
// from the triangle's first block on, so that a small triangle has one; then blocks of 4 x 4, then a block's pixels in
// 32 bits (after Abrash, Rasterization on Larrabee, 2009).
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/exact_kernel.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/native_kernel.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

// Pixels of a block, all at once whatever the registers' width: a small triangle covers parts of most of its blocks,
// and a branch for each register costs more than lanes that are not covered.
inline constexpr int kBlock = 16;
using BlockFloats = Simd<float, kBlock>;
using BlockInts = Simd<std::int32_t, kBlock>;
using BlockMask = SimdMask<kBlock>;

// x and y within a block of its pixels, in memory order.
alignas(64) inline constexpr std::int32_t kPixelX[16] = {0, 1, 0, 1, 2, 3, 2, 3, 0, 1, 0, 1, 2, 3, 2, 3};
alignas(64) inline constexpr std::int32_t kPixelY[16] = {0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3};
alignas(64) inline constexpr std::int32_t kBlockX[16] = {0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12};
alignas(64) inline constexpr std::int32_t kBlockY[16] = {0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12};

// Pixels across a window.
inline constexpr std::uint32_t kWindow = 16;
// Edge values are cut off here: farther from 0 than any step within a window (15 * (|a| + |b|) < 2^29) can lead back.
inline constexpr std::int64_t kEdgeLimit = std::int64_t{1} << 30;

// Calls use(column, row, inside) for each block of the tile of which some pixels are covered.
template <class Use>
TWINSHADE_INLINE void for_each_covered_block(const RasterTriangle& t, const CoverTile& tile, Use use) {
  using I = BlockInts;

  // Steps from a window's first pixel to its blocks' first pixels, from these to their blocks' pixels that are most
  // inside, and from a block's first pixel to all of its pixels.
  std::int64_t window_reach[3];
  I block_step[3], block_reach[3], pixel_step[3];
  for (int e = 0; e < 3; ++e) {
    const I a(t.a[e]), b(t.b[e]);
    const std::int32_t positive_a = t.a[e] > 0 ? t.a[e] : 0, positive_b = t.b[e] > 0 ? t.b[e] : 0;
    window_reach[e] = 15 * (std::int64_t(positive_a) + positive_b);
    block_reach[e] = I(3 * positive_a + 3 * positive_b);
    block_step[e] = a * I::load(kBlockX) + b * I::load(kBlockY);
    pixel_step[e] = a * I::load(kPixelX) + b * I::load(kPixelY);
  }

  // The triangle's pixels within this tile.
  const std::uint32_t tile_end_x = tile.x + tile.size - 1, tile_end_y = tile.y + tile.size - 1;
  const std::uint32_t x0 = t.min_x > tile.x ? t.min_x : tile.x, x1 = t.max_x < tile_end_x ? t.max_x : tile_end_x;
  const std::uint32_t y0 = t.min_y > tile.y ? t.min_y : tile.y, y1 = t.max_y < tile_end_y ? t.max_y : tile_end_y;

  for (std::uint32_t y = y0 & ~3u; y <= y1; y += kWindow)
    for (std::uint32_t x = x0 & ~3u; x <= x1; x += kWindow) {
      I edge[3];
      bool outside = false;
      for (int e = 0; e < 3; ++e) {
        const std::int64_t value = t.c[e] + std::int64_t(t.a[e]) * x + std::int64_t(t.b[e]) * y;
        outside |= value + window_reach[e] < 0;
        edge[e] = I(std::int32_t(value < kEdgeLimit ? value : kEdgeLimit));
      }
      if (outside) continue;

      // Bit k: block k holds pixels of the bounding box and is not wholly outside an edge.
      const std::uint32_t to_column = x1 - x < 15 ? (x1 - x) / 4 : 3, to_row = y1 - y < 15 ? (y1 - y) / 4 : 3;
      const std::uint32_t in_box = (0xfu >> (3 - to_column)) * 0x1111u & 0xffffu >> (12 - 4 * to_row);
      alignas(64) std::int32_t block_edge[3][16];
      I nearest(0);
      for (int e = 0; e < 3; ++e) {
        const I first = edge[e] + block_step[e];
        first.store(block_edge[e]);
        nearest = nearest | (first + block_reach[e]);
      }
      const std::uint32_t column = (x - tile.x) / 4, row = (y - tile.y) / 4;
      const bool at_border = x + kWindow > tile.frame_width || y + kWindow > tile.frame_height;

      for (std::uint32_t blocks = (nearest >= I(0)).bits() & in_box; blocks != 0; blocks &= blocks - 1) {
        const std::uint32_t k = std::uint32_t(__builtin_ctz(blocks));
        I inmost(0);
        for (int e = 0; e < 3; ++e) inmost = inmost | (I(block_edge[e][k]) + pixel_step[e]);
        BlockMask uncovered = inmost < I(0);
        if (at_border)
          uncovered = uncovered | (I::load(kPixelX) >= I(std::int32_t(tile.frame_width - x - k % 4 * 4))) |
                      (I::load(kPixelY) >= I(std::int32_t(tile.frame_height - y - k / 4 * 4)));
        if (all(uncovered)) continue;
        use(column + k % 4, row + k / 4, !uncovered);
      }
    }
}

// Places of a tile's blocks, by column and by row: of their pixels' centres, in NDC or in pixels, and in memory.
template <bool ndc>
struct ComputedPlaces {
  using F = BlockFloats;
  const CoverTile& tile;

  TWINSHADE_INLINE F x(std::uint32_t column) const {
    const F x = F(float(tile.x + 4 * column)) + (BlockInts::load(kPixelX).to<float>() + F(0.5f));
    return ndc ? x * F(tile.vertices->ndc_scale_x) - F(1.0f) : x;
  }
  TWINSHADE_INLINE F y(std::uint32_t row) const {
    const F y = F(float(tile.y + 4 * row)) + (BlockInts::load(kPixelY).to<float>() + F(0.5f));
    return ndc ? y * F(tile.vertices->ndc_scale_y) - F(1.0f) : y;
  }
  TWINSHADE_INLINE std::uint32_t pixel(std::uint32_t column, std::uint32_t row) const {
    return (row / 4 * (tile.size / kSuperblock) * 16 + row % 4 * 4 + column / 4 * 16 + column % 4) * kBlock;
  }
};

// Numbers that are the same in both halves, as the columns of a block are: nothing is computed twice where registers
// hold a half.
template <class F>
TWINSHADE_INLINE F load_alike(const float* from) {
  F x;
  if constexpr (F::whole)
    x = F::load(from);
  else
    x.lo = x.hi = F::Half::load(from);
  return x;
}

// The same, computed once for all triangles of a tile.
template <bool ndc>
class StoredPlaces {
 public:
  using F = BlockFloats;
  explicit StoredPlaces(const CoverTile& tile) {
    const ComputedPlaces<ndc> places{tile};
    for (std::uint32_t k = 0; k < tile.size / 4; ++k) {
      places.x(k).store(x_[k]);
      places.y(k).store(y_[k]);
      column_[k] = places.pixel(k, 0);
      row_[k] = places.pixel(0, k);
    }
  }
  TWINSHADE_INLINE F x(std::uint32_t column) const { return load_alike<F>(x_[column]); }
  TWINSHADE_INLINE F y(std::uint32_t row) const { return F::load(y_[row]); }
  TWINSHADE_INLINE std::uint32_t pixel(std::uint32_t column, std::uint32_t row) const {
    return column_[column] + row_[row];
  }

 private:
  static constexpr int kMost = 32;  // blocks across a tile of 128 pixels
  alignas(64) float x_[kMost][kBlock];
  alignas(64) float y_[kMost][kBlock];
  std::uint32_t column_[kMost], row_[kMost];
};

// Depth of a native triangle: the plane through its window z, evaluated as Mesa does where it has no fused
// multiply-add. x, y: of pixels' centres.
struct NativeDepth {
  using F = BlockFloats;
  static constexpr bool kNdc = false;
  Plane<float> plane;
  TWINSHADE_INLINE NativeDepth(const CoverTile& tile, std::uint32_t which) {
    const NativeTriangle& native = *tile.primitives[tile.locals[which]].native;
    const PlaneSetup<float> setup(native);
    plane = setup.plane(native.position[0].z, native.position[1].z, native.position[2].z);
  }
  TWINSHADE_INLINE F operator()(F x, F y) const {
    const F z = plane.at(x - F(0.5f), y - F(0.5f));
    return select(z < F(1.0f), select(z > F(0.0f), z, F(0.0f)), F(1.0f));
  }
};

// x, y: NDC.
struct ExactDepth {
  using F = BlockFloats;
  static constexpr bool kNdc = true;
  ExactTriangle<F> triangle;
  TWINSHADE_INLINE ExactDepth(const CoverTile& tile, std::uint32_t which)
      : triangle(*tile.vertices, tile.primitives[tile.locals[which]].primitive) {}
  TWINSHADE_INLINE F operator()(F x, F y) const { return triangle.at(x, y).depth(); }
};

// use(first pixel, inside, depth) for the blocks of triangle `which`.
template <class Depth, class Places, class Use>
TWINSHADE_INLINE void cover_with_depth(const CoverTile& tile, const Places& places, std::uint32_t which, Use use) {
  const Depth depth(tile, which);
  for_each_covered_block(*tile.triangles[which], tile,
                         [&](std::uint32_t column, std::uint32_t row, BlockMask inside) TWINSHADE_LAMBDA {
                           use(places.pixel(column, row), inside, depth(places.x(column), places.y(row)));
                         });
}

template <class Depth>
void cover_all(const CoverTile& tile) {
  using F = BlockFloats;
  using U = Simd<std::uint32_t, kBlock>;
  const StoredPlaces<Depth::kNdc> places(tile);
  for (std::uint32_t which = 0; which < tile.count; ++which) {
    const U local(tile.locals[which]);
    // Stored without asking whether any pixel is nearer: the answer comes late, and four times in five it is yes.
    cover_with_depth<Depth>(tile, places, which, [&](std::uint32_t pixel, BlockMask inside, F depth) TWINSHADE_LAMBDA {
      const F old = F::load(tile.depth + pixel);
      const BlockMask nearer = inside & (depth < old);
      blend(nearer, depth, old).store(tile.depth + pixel);
      blend(nearer, local, U::load(tile.visible + pixel)).store(tile.visible + pixel);
    });
  }
}

inline void cover(const CoverTile& tile) {
  if (tile.count == 0) return;
  if (tile.primitives->native)
    cover_all<NativeDepth>(tile);
  else
    cover_all<ExactDepth>(tile);
}

template <class Depth>
std::uint32_t cover_blocks(const CoverTile& tile, std::uint32_t which, bool early_depth_test, VisibleBlock* blocks,
                           float* depths) {
  using F = BlockFloats;
  const ComputedPlaces<Depth::kNdc> places{tile};
  const std::uint32_t local = tile.locals[which];
  std::uint32_t count = 0;
  cover_with_depth<Depth>(tile, places, which, [&](std::uint32_t pixel, BlockMask inside, F depth) TWINSHADE_LAMBDA {
    if (early_depth_test) inside = inside & (depth < F::load(tile.depth + pixel));
    const std::uint32_t coverage = inside.bits();
    blocks[count] = {local, std::uint16_t(pixel / kBlock), std::uint16_t(coverage)};
    depth.store(depths + kBlock * std::size_t{count});
    count += coverage != 0;
  });
  return count;
}

inline std::uint32_t cover_one(const CoverTile& tile, std::uint32_t which, bool early_depth_test, VisibleBlock* blocks,
                               float* depths) {
  return tile.primitives->native ? cover_blocks<NativeDepth>(tile, which, early_depth_test, blocks, depths)
                                 : cover_blocks<ExactDepth>(tile, which, early_depth_test, blocks, depths);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
