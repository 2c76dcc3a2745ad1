// From a tile's order of pixels to the frame's rows; clear where nothing was drawn. Rows of 16 pixels are written at
// once, past the caches: nobody reads the frame before it is done.
#include <algorithm>
#include <cstring>

#include "cpu_shaders/runtime/simd_lanes.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {
namespace {

using F4 = Simd<float, 4>;
using U4 = Simd<std::uint32_t, 4>;

// Whole cache lines are combined on their way to memory, without being read first. `to` is 16-byte aligned.
void stream(float* to, F4 value) {
#if defined(__SSE2__)
  _mm_stream_ps(to, reinterpret_cast<__m128>(value.v));
#else
  value.store(to);
#endif
}
void stream(std::uint32_t* to, U4 value) { stream(reinterpret_cast<float*>(to), value.as<float>()); }

void streams_done() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

// Where pixel (x, y) of a superblock is in memory.
constexpr std::uint32_t in_superblock(std::uint32_t x, std::uint32_t y) {
  return (y / 4 * 4 + x / 4) * 16 + (y % 4 / 2 * 2 + x % 4 / 2) * 4 + y % 2 * 2 + x % 2;
}

}  // namespace

void TileWorker::store_tile() {
  const Frame& frame = draw_.frame;
  const std::uint32_t a_row = tile_.size / kSuperblock;
  const bool aligned = frame.width % 4 == 0;
  for (std::uint32_t superblock = 0; superblock < a_row * a_row; ++superblock) {
    const std::uint32_t x = tile_.x + superblock % a_row * kSuperblock, y = tile_.y + superblock / a_row * kSuperblock;
    const std::uint32_t first = superblock * kSuperblock * kSuperblock;
    if (aligned && x + kSuperblock <= frame.width && y + kSuperblock <= frame.height && !draw_.float64())
      store_superblock(first, x, y);
    else
      store_superblock_by_pixels(first, x, y);
  }
  streams_done();
}

void TileWorker::store_superblock(std::uint32_t first, std::uint32_t x, std::uint32_t y) {
  Frame& frame = draw_.frame;
  const F4 clear(0.0f);
  for (std::uint32_t row = 0; row < kSuperblock; ++row) {
    const std::size_t pixel = std::size_t(y + row) * frame.width + x;
    for (std::uint32_t column = 0; column < kSuperblock; column += 4) {
      // Four pixels: the rows of two quads.
      const std::uint32_t left = first + in_superblock(column, row), right = left + 4;
      float depth[4];
      std::uint32_t id[4];
      std::memcpy(depth, &tile_.depth[left], 8);
      std::memcpy(depth + 2, &tile_.depth[right], 8);
      std::uint8_t* coverage = &frame.coverage[pixel + column];
      float* color = &frame.color[4 * (pixel + column)];
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t from = (i < 2 ? left : right) + i % 2;
        const std::uint32_t local = tile_.visible[from];
        const bool drawn = local != kNotVisible;
        coverage[i] = drawn;
        id[i] = drawn ? primitives_[local].primitive : kNoPrimitive;
        stream(color + 4 * i, drawn ? F4::load(&color_[4 * std::size_t(from)]) : clear);
      }
      stream(&frame.depth[pixel + column], F4::load(depth));
      stream(&frame.primitive_id[pixel + column], U4::load(id));
    }
  }
}

// At the frame's border, and for colours in double.
void TileWorker::store_superblock_by_pixels(std::uint32_t first, std::uint32_t x0, std::uint32_t y0) {
  Frame& frame = draw_.frame;
  for (std::uint32_t y = y0; y < std::min(y0 + kSuperblock, frame.height); ++y)
    for (std::uint32_t x = x0; x < std::min(x0 + kSuperblock, frame.width); ++x) {
      const std::size_t from = first + in_superblock(x - x0, y - y0), pixel = std::size_t(y) * frame.width + x;
      const std::uint32_t local = tile_.visible[from];
      const bool drawn = local != kNotVisible;
      frame.depth[pixel] = tile_.depth[from];
      frame.coverage[pixel] = drawn;
      frame.primitive_id[pixel] = drawn ? primitives_[local].primitive : kNoPrimitive;
      (drawn ? F4::load(&color_[4 * from]) : F4(0.0f)).store(&frame.color[4 * pixel]);
      if (!drawn && draw_.float64()) std::fill_n(&frame.color64[4 * pixel], 4, 0.0);
    }
}

}  // namespace twinshade::tiled
