// Shading from a visibility buffer (Burns and Hunt, The visibility buffer, JCGT 2013): once all triangles of a tile
// have been covered, each pixel is shaded once. Where the shader has derivatives, whole 2 x 2 quads are, once for each
// primitive visible in them.
#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

// Blocks of one primitive side by side, so that interpolation broadcasts its vertex data: a counting sort. Primitive
// ids are known here, and which blocks will not be filled with colour.
void TileWorker::collect_visible() {
  place_of_local_.assign(primitive_count_ + 1, 0);
  found_.resize(std::size_t(tile_.size) * tile_.size);
  const std::uint32_t count = draw_.kernels.collect_visible({&tile_, found_.data(), place_of_local_.data(),
                                                             draw_.options.visibility ? primitive_id_.data() : nullptr,
                                                             kNoPrimitive, color_.data()});
  for (std::size_t i = 1; i < place_of_local_.size(); ++i) place_of_local_[i] += place_of_local_[i - 1];
  sorted_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) sorted_[place_of_local_[found_[i].local]++] = found_[i];
}

void TileWorker::shade_visible() {
  {
    const FlushDenormals flush;
    draw_.kernels.cover(tile_);
  }
  collect_visible();
  ticks_.lap(Stage::raster);

  for (std::size_t taken = 0; taken < sorted_.size();) {
    taken += batch_.add(&sorted_[taken], sorted_.size() - taken);
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
