// Shading from a visibility buffer (Burns and Hunt, The visibility buffer, JCGT 2013): once all triangles of a tile
// have been covered, each pixel is shaded once. Where the shader has derivatives, whole 2 x 2 quads are, once for each
// triangle visible in them (clipping may make several of a primitive).
#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

void TileWorker::shade_visible() {
  const Kernels& kernels = draw_.kernels;
  blocks_.resize(kBlockRoom * std::size_t(tile_.size) * tile_.size);
  tile_.blocks = blocks_.data();
  sort_groups();
  std::uint32_t count;
  {
    const FlushDenormals flush;
    count = kernels.cover(tile_);
  }
  // Blocks of one primitive are side by side, so that interpolation broadcasts its vertex data.
  count = kernels.collect_visible(
      {&tile_, count, draw_.options.visibility ? primitive_id_.data() : nullptr, kNoPrimitive, color_.data()});
  ticks_.lap(Stage::raster);

  for (std::size_t taken = 0; taken < count;) {
    taken += batch_.add(&blocks_[taken], count - taken);
    if (batch_.full()) shade_batch();
  }
  if (batch_.count() > 0) shade_batch();
}

void TileWorker::shade_batch() {
  batch_.shade(primitives_.data(), ticks_);
  batch_.store(color_.data());
  batch_.clear();
  ticks_.lap(Stage::store);
}

}  // namespace twinshade::tiled
