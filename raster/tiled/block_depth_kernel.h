// Depth at the pixels of a 4 x 4 block, and where blocks are.
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

// What a compiler cannot tell to be the same pointer: numbers that it would keep in registers, of which there are too
// few, are read from memory by the instructions that need them. The pointer escapes into the asm, so that what was
// stored before stays and can be what the result points to; without volatile or a clobber equal calls may become one.
template <class T>
TWINSHADE_INLINE T* hidden(T* pointer) {
  asm("" : "+r"(pointer));
  return pointer;
}

// Numbers that repeat after `period` ones: registers of no more lanes are loaded once for all of F. A wider one is
// loaded whole.
template <int period, class F>
TWINSHADE_INLINE F load_repeating(const float* from) {
  F x;
  if constexpr (F::whole || F::width <= period)
    x = F::load(from);
  else
    x.lo = x.hi = load_repeating<period, typename F::Half>(from);
  return x;
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

  struct Window {
    const ComputedPlaces& places;
    std::uint32_t column, row;
    TWINSHADE_INLINE F x(std::size_t block) const { return places.x(column + block % 4); }
    TWINSHADE_INLINE F y(std::size_t block) const { return places.y(row + block / 4); }
    TWINSHADE_INLINE std::size_t pixel(std::size_t block) const {
      return places.pixel(column + block % 4, row + block / 4);
    }
  };
  TWINSHADE_INLINE Window window(std::uint32_t column, std::uint32_t row) const { return {*this, column, row}; }
};

// The same, computed once for all triangles of a tile.
template <bool ndc>
class StoredPlaces {
  struct alignas(64) Column {
    float x[kBlock];
    std::size_t pixel;
  };
  struct alignas(64) Row {
    float y[kBlock];
    std::size_t pixel;
  };

 public:
  using F = BlockFloats;
  explicit StoredPlaces(const CoverTile& tile) {
    const ComputedPlaces<ndc> places{tile};
    for (std::uint32_t k = 0; k < tile.size / 4; ++k) {
      places.x(k).store(columns_[k].x);
      places.y(k).store(rows_[k].y);
      columns_[k].pixel = places.pixel(k, 0);
      rows_[k].pixel = places.pixel(0, k);
    }
  }

  struct Window {
    const Column* columns;
    const Row* rows;
    std::uint32_t column, row;
    // Both halves of a block have the same columns.
    TWINSHADE_INLINE F x(std::size_t block) const { return load_repeating<kBlock / 2, F>(columns[block % 4].x); }
    TWINSHADE_INLINE F y(std::size_t block) const { return F::load(rows[block / 4].y); }
    TWINSHADE_INLINE std::size_t pixel(std::size_t block) const {
      return columns[block % 4].pixel + rows[block / 4].pixel;
    }
  };
  TWINSHADE_INLINE Window window(std::uint32_t column, std::uint32_t row) const {
    return {hidden(columns_ + column), hidden(rows_ + row), column, row};
  }

 private:
  static constexpr int kMost = 32;  // blocks across a tile of 128 pixels
  Column columns_[kMost];
  Row rows_[kMost];
};

// Depths are from +0 to 1, neither -0 nor NaN: they are compared by their bits.

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

// The number that fills a register, in all of F's; where these are several, the second half's from `second`.
template <class F>
TWINSHADE_INLINE F load_same(const float* from, const float* second) {
  F x = load_repeating<kNativeLanes, F>(from);
  if constexpr (!F::whole) x.hi = load_repeating<kNativeLanes, typename F::Half>(second);
  return x;
}

// x, y: NDC.
class ExactDepth {
 public:
  using F = BlockFloats;
  static constexpr bool kNdc = true;
  TWINSHADE_INLINE ExactDepth(const CoverTile& tile, std::uint32_t which) {
    using R = Simd<float, kNativeLanes>;
    const std::uint32_t primitive = tile.primitives[tile.locals[which]].primitive;
    for (int v = 0; v < 3; ++v) {
      const float* p = clip_position(*tile.vertices, primitive, v);
      R(p[0]).store(corners_.x[v]);
      R(p[1]).store(corners_.y[v]);
      R(p[2]).store(corners_.z[v]);
      const R w(p[3]);
      w.store(corners_.w[v]);
      (-w).store(corners_.minus_w[v]);
    }
  }
  TWINSHADE_INLINE F operator()(F x, F y) const {
    // A second half reads the same numbers as if they were others: instructions take them from memory then, instead of
    // moving them to registers first to use them twice. Without one they stay in registers.
    const Corners *lo = &corners_, *hi = lo;
    if constexpr (!F::whole) hi = hidden(lo);
    ExactTriangle<F> t;
    for (int v = 0; v < 3; ++v) {
      t.x[v] = load_repeating<kNativeLanes, F>(lo->x[v]);
      t.minus_w[v] = load_repeating<kNativeLanes, F>(lo->minus_w[v]);
    }
    const auto columns = t.columns(x);
    for (int v = 0; v < 3; ++v) {
      t.y[v] = load_same<F>(lo->y[v], hi->y[v]);
      t.z[v] = load_same<F>(lo->z[v], hi->z[v]);
      t.w[v] = load_same<F>(lo->w[v], hi->w[v]);
      t.minus_w[v] = load_same<F>(lo->minus_w[v], hi->minus_w[v]);
    }
    return t.at(columns, y).depth();
  }

 private:
  // Clip space, each number in all lanes of a register.
  struct Corners {
    alignas(64) float x[3][kNativeLanes], y[3][kNativeLanes], z[3][kNativeLanes], w[3][kNativeLanes],
        minus_w[3][kNativeLanes];
  };
  Corners corners_;
};

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
