// Shading from a visibility buffer (Burns and Hunt, The visibility buffer, JCGT 2013): once all triangles of a tile
// have been covered, each 2 x 2 quad is shaded once for each primitive visible in it.
#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

// Quads of one primitive side by side, so that interpolation broadcasts its vertex data: a counting sort.
void TileWorker::collect_visible_quads() {
  found_.clear();
  place_of_local_.assign(primitives_.size() + 1, 0);
  const std::uint32_t quads = tile_.size * tile_.size / 4;
  for (std::uint32_t quad = 0; quad < quads; ++quad) {
    const std::uint32_t* visible = tile_.visible + 4 * quad;
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < 4; ++i) left |= (visible[i] != kNotVisible ? 1u : 0u) << i;
    while (left != 0) {
      const std::uint32_t local = visible[__builtin_ctz(left)];
      std::uint32_t coverage = 0;
      for (std::uint32_t i = 0; i < 4; ++i) coverage |= (visible[i] == local ? 1u : 0u) << i;
      left &= ~coverage;
      found_.push_back({local, std::uint16_t(quad), std::uint16_t(coverage)});
      ++place_of_local_[local + 1];
    }
  }
  for (std::size_t i = 1; i < place_of_local_.size(); ++i) place_of_local_[i] += place_of_local_[i - 1];
  sorted_.resize(found_.size());
  for (const VisibleQuad& quad : found_) sorted_[place_of_local_[quad.local]++] = quad;
}

void TileWorker::shade_visible() {
  {
    const FlushDenormals flush;
    draw_.kernels.cover(tile_);
  }
  collect_visible_quads();
  clock_.lap(Stage::raster);

  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    const VisibleQuad& quad = sorted_[i];
    batch_.add(place(quad.quad, quad.local), quad.coverage);
    if (!batch_.full() && i + 1 < sorted_.size()) continue;
    batch_.shade(primitives_.data(), clock_);
    for (std::uint32_t q = 0; q < batch_.count(); ++q) batch_.store(q, batch_.coverage(q));
    batch_.clear();
    clock_.lap(Stage::store);
  }
}

}  // namespace twinshade::tiled
