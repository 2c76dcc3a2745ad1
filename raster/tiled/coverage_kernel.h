// Which pixels a triangle covers and how deep it is there. Hierarchy: windows of 16 x 16 pixels in 64-bit arithmetic,
// from the triangle's first block on, so that a small triangle has one; then blocks of 4 x 4, then a block's pixels in
// 32 bits (after Abrash, Rasterization on Larrabee, 2009). Blocks in which it is hidden are left out.
#pragma once

#include "raster/tiled/block_depth_kernel.h"
#include "raster/tiled/farthest_depths_kernel.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/visible_kernel.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

alignas(64) inline constexpr std::int32_t kBlockX[16] = {0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12};
alignas(64) inline constexpr std::int32_t kBlockY[16] = {0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12};

// Pixels across a window.
inline constexpr std::uint32_t kWindow = 16;
// Edge values are cut off here: farther from 0 than any step within a window (15 * (|a| + |b|) < 2^29) can lead back.
inline constexpr std::int64_t kEdgeLimit = std::int64_t{1} << 30;

// The bits of 1.0f, the depth where nothing was drawn.
inline constexpr std::int32_t kFarthest = 0x3f800000;

// A number of each edge. The fourth lane means nothing.
using Edges = Register<std::int64_t, 4>;
using Edges32 = Register<std::int32_t, 4>;

TWINSHADE_INLINE Edges widened(Edges32 x) {
#if defined(__AVX2__)
  return (Edges)_mm256_cvtepi32_epi64((__m128i)x);
#else
  return Edges{x[0], x[1], x[2], 0};
#endif
}
TWINSHADE_INLINE Edges product(Edges32 x, std::int32_t y) {
#if defined(__AVX2__)
  return (Edges)_mm256_mul_epi32((__m256i)widened(x), _mm256_set1_epi32(y));
#else
  return widened(x) * std::int64_t{y};
#endif
}
// Of the three.
TWINSHADE_INLINE bool any_negative(Edges x) {
#if defined(__AVX2__)
  return (_mm256_movemask_pd((__m256d)x) & 7) != 0;
#else
  return (x[0] | x[1] | x[2]) < 0;
#endif
}

// Whether all lanes are negative.
template <class I>
TWINSHADE_INLINE bool all_negative(I x) {
  if constexpr (I::whole)
    return all(x < I(0));
  else
    return all_negative(x.lo & x.hi);
}

// A triangle's pixels within a tile, from the tile's first one, and windows of 4 x 4 blocks over them: x, y of such a
// window's first pixel are first_x, first_y and each kWindow farther, up to x1, y1.
struct Box {
  std::uint32_t first_x, first_y, x1, y1;

  // Its bounding box has pixels in the tile.
  TWINSHADE_INLINE Box(const RasterTriangle& t, const CoverTile& tile) {
    const std::uint32_t min_x = t.min_x, max_x = t.max_x, min_y = t.min_y, max_y = t.max_y, last = tile.size - 1;
    const std::uint32_t x0 = min_x > tile.x ? min_x - tile.x : 0, y0 = min_y > tile.y ? min_y - tile.y : 0;
    first_x = x0 & ~3u, first_y = y0 & ~3u;
    x1 = max_x - tile.x < last ? max_x - tile.x : last;
    y1 = max_y - tile.y < last ? max_y - tile.y : last;
  }

  // Bit k: block k of the window, by rows, has pixels in these rows or columns.
  TWINSHADE_INLINE std::uint32_t rows_from(std::uint32_t y) const {
    const std::uint32_t rows_left = (y1 - y) / 4;
    return 0xffffu >> (12 - 4 * (rows_left < 3 ? rows_left : 3));
  }
  TWINSHADE_INLINE std::uint32_t columns_from(std::uint32_t x) const {
    const std::uint32_t columns_left = (x1 - x) / 4;
    return 0x1111u * (0xfu >> (3 - (columns_left < 3 ? columns_left : 3)));
  }

  // Whether all of its blocks are left out. left_out: as for_each_covered_block's.
  template <class LeftOut>
  TWINSHADE_INLINE bool all_left_out(LeftOut left_out) const {
    for (std::uint32_t y = first_y; y <= y1; y += kWindow)
      for (std::uint32_t x = first_x; x <= x1; x += kWindow)
        if ((rows_from(y) & columns_from(x) & ~left_out(x / 4, y / 4)) != 0) return false;
    return true;
  }
};

// Calls use(places.window(column, row), block, inmost) for each block of the tile of which some pixels are covered:
// those whose lane of inmost is not negative. column, row: of a window of 4 x 4 blocks, in blocks from the tile's first
// one; block: 0 to 15, by rows. left_out(column, row): bit k of its result says that block k need not be looked at.
template <class Places, class LeftOut, class Use>
TWINSHADE_INLINE void for_each_covered_block(const RasterTriangle& t, const CoverTile& tile, const Box& box,
                                             const Places& places, LeftOut left_out, Use use) {
  using I = BlockInts;
  const bool at_border = tile.x + tile.size > tile.frame_width || tile.y + tile.size > tile.frame_height;

  // Steps from windows' first pixels to their blocks' first pixels, from these to their blocks' pixels that are most
  // inside, and from a block's first pixel to all of its pixels.
  struct alignas(64) Steps {
    std::int32_t block[3][16], reach[3][16], pixel[3][16];
  } all_steps;
  // The fourth lanes are what follows in the triangle; that of b is cleared, since it might overflow.
  static_assert(offsetof(RasterTriangle, c) + 32 <= sizeof(RasterTriangle) &&
                offsetof(RasterTriangle, b) + 16 <= sizeof(RasterTriangle));
  const Edges32 a = registers::load<4>(t.a), b = registers::load<4>(t.b) & Edges32{-1, -1, -1, 0};
  const Edges32 inwards = (a > 0 ? a : Edges32{}) + (b > 0 ? b : Edges32{}), three = inwards + inwards + inwards;
  for (int e = 0; e < 3; ++e) {
    const I a_e(t.a[e]), b_e(t.b[e]);
    (a_e * I::load(kBlockX) + b_e * I::load(kBlockY)).store(all_steps.block[e]);
    I(three[e]).store(all_steps.reach[e]);
    (a_e * I::load(kPixelX) + b_e * I::load(kPixelY)).store(all_steps.pixel[e]);
  }
  const Steps& steps = *hidden(&all_steps);
  // Of windows' first pixels: steps to their pixels that are most inside, to the next window's, to the next row's.
  const Edges reach = widened((inwards << 4) - inwards), step_x = widened(a << 4), step_y = widened(b << 4);
  Edges first_in_row = registers::load<4>(t.c) + product(a, std::int32_t(tile.x + box.first_x)) +
                       product(b, std::int32_t(tile.y + box.first_y));
  const Edges limit = Edges{} + kEdgeLimit;

  for (std::uint32_t y = box.first_y; y <= box.y1; y += kWindow, first_in_row += step_y) {
    const std::uint32_t rows_in_box = box.rows_from(y);
    Edges first = first_in_row;
    for (std::uint32_t x = box.first_x; x <= box.x1; x += kWindow) {
      const Edges here = first;
      first += step_x;
      if (any_negative(here + reach)) continue;
      // Bit k: block k holds pixels of the bounding box; then, it is not wholly outside an edge.
      const std::uint32_t in_box = rows_in_box & box.columns_from(x) & ~left_out(x / 4, y / 4);
      if (in_box == 0) continue;
      alignas(32) std::int64_t edge[4];
      registers::store(edge, here < limit ? here : limit);
      alignas(64) std::int32_t block_edge[3][16];
      I nearest(0);
      for (int e = 0; e < 3; ++e) {
        const I blocks = I(std::int32_t(edge[e])) + I::load(steps.block[e]);
        blocks.store(block_edge[e]);
        nearest = nearest | (blocks + I::load(steps.reach[e]));
      }
      const auto window_places = places.window(x / 4, y / 4);

      for (std::uint32_t blocks = ~(nearest < I(0)).bits() & in_box; blocks != 0; blocks &= blocks - 1) {
        const std::uint32_t k = std::uint32_t(__builtin_ctz(blocks));
        I inmost(0);
        for (int e = 0; e < 3; ++e) inmost = inmost | (I(block_edge[e][k]) + I::load(steps.pixel[e]));
        if (at_border)
          inmost = inmost | (I(std::int32_t(tile.frame_width - 1 - tile.x - x - k % 4 * 4)) - I::load(kPixelX)) |
                   (I(std::int32_t(tile.frame_height - 1 - tile.y - y - k / 4 * 4)) - I::load(kPixelY));
        // Where a mask is a register's the branch costs more than it spares.
        if constexpr (!BlockInts::whole)
          if (all_negative(inmost)) continue;
        use(window_places, std::size_t{k}, inmost);
      }
    }
  }
}

// Stores lanes whose mask is set.
TWINSHADE_INLINE void store_where(BlockMask mask, const Simd<std::uint32_t, kBlock>& lanes, std::uint32_t* to) {
#if defined(__AVX512F__)
  _mm512_mask_storeu_epi32(to, static_cast<__mmask16>(mask.bits()), (__m512i)lanes.v);
#else
  blend(mask, lanes, Simd<std::uint32_t, kBlock>::load(to)).store(to);
#endif
}

// The bits that depths must be less than to show at a block's pixels: of primitives that are as deep the first one
// does, and it is less than what is one unit farther. kNotVisible is -1, before all of them, so that nothing shows
// at 1.
TWINSHADE_INLINE BlockInts depth_limit(const BlockInts& old_depth, const std::uint32_t* visible,
                                       const BlockInts& number) {
  const auto shown = Simd<std::uint32_t, kBlock>::load(visible).template as<std::int32_t>();
  return old_depth + select(number < shown, BlockInts(1), BlockInts(0));
}

TWINSHADE_INLINE std::uint32_t group_end(const CoverTile& tile, std::uint32_t first) {
  return tile.count - first < kTrianglesTogether ? tile.count : first + kTrianglesTogether;
}

// Asks for the corners of the next group's triangles, and for what says which those are of the group after it: groups
// lie apart.
TWINSHADE_INLINE void ask_for_corners(const CoverTile& tile, std::uint32_t group) {
  const VertexData& vertices = *tile.vertices;
  const auto for_each_triangle = [&](std::uint32_t which_group, auto use) TWINSHADE_LAMBDA {
    if (which_group >= tile.group_count) return;
    const std::uint32_t first = tile.groups[which_group].first, end = group_end(tile, first);
    for (std::uint32_t which = first; which < end; ++which)
      use(vertices.indices + std::size_t{tile.triangles[which]->primitive} * 3);
  };
  for_each_triangle(group + 2, [](const std::uint32_t* index) TWINSHADE_LAMBDA { __builtin_prefetch(index); });
  for_each_triangle(group + 1, [&](const std::uint32_t* index) TWINSHADE_LAMBDA {
    for (int v = 0; v < 3; ++v) __builtin_prefetch(vertices.clip_positions + std::size_t{index[v]} * 4);
  });
}

template <class Depth>
std::uint32_t cover_all(const CoverTile& tile) {
  using F = BlockFloats;
  using I = BlockInts;
  const StoredPlaces<Depth::kNdc> places(tile);
  const FarthestDepths farthest(tile);
  float* const depths = tile.depth;
  std::uint32_t* const visible = tile.visible;
  const std::uint32_t pixels = tile.size * tile.size;
  VisibleBlock* next = tile.blocks;
  VisibleBlock* const almost_full = next + (kBlockRoom * pixels - pixels / kBlock);
  const auto cover_triangle = [&](std::uint32_t which) TWINSHADE_LAMBDA {
    if (next > almost_full)
      next = tile.blocks + keep_visible(tile, std::uint32_t(next - tile.blocks),
                                        [](std::uint32_t triangle, std::uint32_t, const auto&)
                                            TWINSHADE_LAMBDA { return triangle; });
    const RasterTriangle& t = *tile.triangles[which];
    const auto is_hidden = [&](std::uint32_t column, std::uint32_t row)
                               TWINSHADE_LAMBDA { return farthest.nearer_than(t.nearest, column, row); };
    const Box box(t, tile);
    if (box.all_left_out(is_hidden)) return;
    const I triangle(static_cast<std::int32_t>(which));
    const Depth depth_at(tile, which);
    // Stored without asking whether any pixel is nearer: the answer comes late, and is nearly always yes.
    for_each_covered_block(
        t, tile, box, places, is_hidden, [&](const auto& window, std::size_t block, I inmost) TWINSHADE_LAMBDA {
          const std::size_t pixel = window.pixel(block);
          // Depths are from +0 to 1: their bits compare as they do. Where the triangle is not they become 1, nearer
          // than none that is stored, so that what is stored is a minimum: the triangle that covers the block next
          // waits for it, and would wait longer for a mask.
          const I depth = blend(inmost < I(0), I(kFarthest),
                                depth_at(window.x(block), window.y(block)).template as<std::int32_t>());
          const I old = F::load(depths + pixel).template as<std::int32_t>(), now = lanes_min(depth, old);
          now.template as<float>().store(depths + pixel);
          store_where(depth < depth_limit(old, visible + pixel, triangle), triangle.template as<std::uint32_t>(),
                      visible + pixel);
          farthest.set(window.column, window.row, block, now);
          *next++ = {which, std::uint16_t(pixel / kBlock), 0};
        });
  };
  // Groups come by what is nearest of each.
  constexpr std::uint32_t kGroupsBetweenLooks = 8;
  for (std::uint32_t group = 0; group < tile.group_count; ++group) {
    const auto [nearest, first] = tile.groups[group];
    if (group % kGroupsBetweenLooks == kGroupsBetweenLooks - 1 && farthest.all_nearer_than(nearest)) break;
    ask_for_corners(tile, group);
    for (std::uint32_t which = first, end = group_end(tile, first); which < end; ++which) cover_triangle(which);
  }
  return std::uint32_t(next - tile.blocks);
}

inline std::uint32_t cover(const CoverTile& tile) {
  if (tile.count == 0) return 0;
  return tile.primitives->native ? cover_all<NativeDepth>(tile) : cover_all<ExactDepth>(tile);
}

template <class Depth>
std::uint32_t cover_blocks(const CoverTile& tile, std::uint32_t which, bool early_depth_test, VisibleBlock* blocks,
                           float* depths) {
  using F = BlockFloats;
  using I = BlockInts;
  const ComputedPlaces<Depth::kNdc> places{tile};
  const RasterTriangle& t = *tile.triangles[which];
  const FarthestDepths farthest(tile);
  const float nearest = early_depth_test ? t.nearest : -1.0f;
  const auto is_hidden = [&](std::uint32_t column, std::uint32_t row)
                             TWINSHADE_LAMBDA { return farthest.nearer_than(nearest, column, row); };
  const Box box(t, tile);
  if (box.all_left_out(is_hidden)) return 0;
  const std::uint32_t local = tile.locals[which];
  const I this_one(static_cast<std::int32_t>(local));
  const Depth depth_at(tile, which);
  std::uint32_t count = 0;
  for_each_covered_block(
      t, tile, box, places, is_hidden, [&](const auto& window, std::size_t block, I inmost) TWINSHADE_LAMBDA {
        const std::size_t pixel = window.pixel(block);
        const F depth = depth_at(window.x(block), window.y(block));
        BlockMask inside = inmost >= I(0);
        if (early_depth_test) {
          // Whoever stores depths later does not say so here: the next triangle learns from this one's look.
          const I old = F::load(tile.depth + pixel).template as<std::int32_t>();
          farthest.set(window.column, window.row, block, old);
          inside = inside & (depth.template as<std::int32_t>() < depth_limit(old, tile.visible + pixel, this_one));
        }
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
