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

// The lower and upper row of sixteen pixels, from the quads of four blocks.
template <class V>
struct Rows {
  V low[4], high[4];
  explicit Rows(const typename V::element* blocks) {
    for (int i = 0; i < 4; ++i) {
      const V left = V::load(blocks + 16 * i), right = V::load(blocks + 16 * i + 4);
      low[i].v = __builtin_shufflevector(left.v, right.v, 0, 1, 4, 5);
      high[i].v = __builtin_shufflevector(left.v, right.v, 2, 3, 6, 7);
    }
  }
  void stream_to(typename V::element* row, std::size_t width) const {
    for (int i = 0; i < 4; ++i) stream(row + 4 * i, low[i]);
    for (int i = 0; i < 4; ++i) stream(row + width + 4 * i, high[i]);
  }
};

// [m]: byte i is 1 where bit i of m is set.
constexpr std::uint32_t kCoverageBytes[16] = {0x00000000, 0x00000001, 0x00000100, 0x00000101, 0x00010000, 0x00010001,
                                              0x00010100, 0x00010101, 0x01000000, 0x01000001, 0x01000100, 0x01000101,
                                              0x01010000, 0x01010001, 0x01010100, 0x01010101};

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
  const std::size_t width = frame.width;
  for (std::uint32_t row = 0; row < kSuperblock; row += 2) {
    const std::size_t pixel = (y + row) * width + x;
    const std::size_t from = first + in_superblock(0, row);  // four blocks on, each 16 pixels further
    // Each line of memory is filled by stores that follow each other: processors combine few lines at a time.
    for (std::size_t up = 0; up < 2; ++up)
      for (std::size_t quad = 0; quad < 8; ++quad) {
        const float* color = &color_[4 * (from + quad / 2 * 16 + quad % 2 * 4 + 2 * up)];
        float* to = &frame.color[4 * (pixel + up * width + 2 * quad)];
        stream(to, F4::load(color));
        stream(to + 4, F4::load(color + 4));
      }
    const Rows<F4> depth(&tile_.depth[from]);
    depth.stream_to(&frame.depth[pixel], width);
    if (!draw_.options.visibility) continue;
    const Rows<U4> id(&primitive_id_[from]);
    id.stream_to(&frame.primitive_id[pixel], width);
    for (std::size_t block = 0; block < 4; ++block) {
      const std::uint32_t bytes[2] = {kCoverageBytes[(id.low[block] != U4(kNoPrimitive)).bits()],
                                      kCoverageBytes[(id.high[block] != U4(kNoPrimitive)).bits()]};
      std::memcpy(&frame.coverage[pixel + 4 * block], &bytes[0], 4);
      std::memcpy(&frame.coverage[pixel + 4 * block + width], &bytes[1], 4);
    }
  }
}

// At the frame's border, and for colours in double.
void TileWorker::store_superblock_by_pixels(std::uint32_t first, std::uint32_t x0, std::uint32_t y0) {
  Frame& frame = draw_.frame;
  for (std::uint32_t y = y0; y < std::min(y0 + kSuperblock, frame.height); ++y)
    for (std::uint32_t x = x0; x < std::min(x0 + kSuperblock, frame.width); ++x) {
      const std::size_t from = first + in_superblock(x - x0, y - y0), pixel = std::size_t(y) * frame.width + x;
      frame.depth[pixel] = tile_.depth[from];
      F4::load(&color_[4 * from]).store(&frame.color[4 * pixel]);
      if (draw_.options.visibility) {
        frame.coverage[pixel] = primitive_id_[from] != kNoPrimitive;
        frame.primitive_id[pixel] = primitive_id_[from];
      }
      if (draw_.float64() && tile_.visible[from] == kNotVisible) std::fill_n(&frame.color64[4 * pixel], 4, 0.0);
    }
}

}  // namespace twinshade::tiled
