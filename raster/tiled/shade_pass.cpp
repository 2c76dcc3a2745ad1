// Shading from a visibility buffer (Burns and Hunt, The visibility buffer, JCGT 2013): once all triangles of a tile
// have been covered, each pixel is shaded once. Where the shader has derivatives, whole 2 x 2 quads are, once for each
// triangle visible in them (clipping may make several of a primitive).
#include <algorithm>

#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

// Groups by what is nearest of each: what they cover hides others, which cost little then. Of a few neighbours each,
// lest vertices be read in no order at all.
void TileWorker::sort_groups() {
  groups_.clear();
  for (std::uint32_t first = 0; first < tile_.count; first += kTrianglesTogether) {
    float nearest = 1;
    for (std::uint32_t i = first, end = group_end(first); i < end; ++i)
      nearest = std::min(nearest, tile_.triangles[i]->nearest);
    groups_.push_back({nearest, first});
  }
  std::sort(groups_.begin(), groups_.end(),
            [](const TriangleGroup& a, const TriangleGroup& b) { return a.nearest < b.nearest; });
  tile_.groups = groups_.data();
  tile_.group_count = std::uint32_t(groups_.size());
}

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
