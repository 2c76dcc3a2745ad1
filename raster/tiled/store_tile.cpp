// A tile to the frame: by superblocks, or by pixels where one is cut off or colours are doubles.
#include <algorithm>

#include "raster/tiled/draw.h"
#include "raster/tiled/store_superblock_kernel.h"

namespace twinshade::tiled {
namespace {

void streams_done() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

}  // namespace

void TileWorker::store_tile() {
  const Frame& frame = draw_.frame;
  const std::uint32_t a_row = tile_.size / kSuperblock;
  for (std::uint32_t superblock = 0; superblock < a_row * a_row; ++superblock) {
    const std::uint32_t x = tile_.x + superblock % a_row * kSuperblock, y = tile_.y + superblock / a_row * kSuperblock;
    const std::uint32_t first = superblock * kSuperblock * kSuperblock;
    if (x + kSuperblock <= frame.width && y + kSuperblock <= frame.height && !draw_.float64())
      store_superblock(first, x, y);
    else
      store_superblock_by_pixels(first, x, y);
  }
  streams_done();
}

void TileWorker::store_superblock(std::uint32_t first, std::uint32_t x, std::uint32_t y) {
  Frame& frame = draw_.frame;
  const std::size_t pixel = std::size_t(y) * frame.width + x;
  const bool visibility = draw_.options.visibility;
  const bool aligned = frame.width % 4 == 0;  // frames begin cache lines, superblocks at 16 n
  draw_.kernels.store_superblock({&color_[4 * std::size_t(first)], &tile_.depth[first], &primitive_id_[first],
                                  &frame.color[4 * pixel], &frame.depth[pixel],
                                  visibility ? &frame.primitive_id[pixel] : nullptr,
                                  visibility ? &frame.coverage[pixel] : nullptr, kNoPrimitive, frame.width, aligned});
}

// At the frame's border, and for colours in double.
void TileWorker::store_superblock_by_pixels(std::uint32_t first, std::uint32_t x0, std::uint32_t y0) {
  Frame& frame = draw_.frame;
  for (std::uint32_t y = y0; y < std::min(y0 + kSuperblock, frame.height); ++y)
    for (std::uint32_t x = x0; x < std::min(x0 + kSuperblock, frame.width); ++x) {
      const std::size_t from = first + in_superblock(x - x0, y - y0), pixel = std::size_t(y) * frame.width + x;
      frame.depth[pixel] = tile_.depth[from];
      std::copy_n(&color_[4 * from], 4, &frame.color[4 * pixel]);
      if (draw_.options.visibility) {
        frame.coverage[pixel] = primitive_id_[from] != kNoPrimitive;
        frame.primitive_id[pixel] = primitive_id_[from];
      }
      if (draw_.float64() && tile_.visible[from] == kNotVisible) std::fill_n(&frame.color64[4 * pixel], 4, 0.0);
    }
}

}  // namespace twinshade::tiled
