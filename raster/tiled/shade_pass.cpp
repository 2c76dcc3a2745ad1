// Shading from a visibility buffer (Burns and Hunt, The visibility buffer, JCGT 2013): once all triangles of a tile
// have been covered, each pixel is shaded once. Where the shader has derivatives, whole 2 x 2 quads are, once for each
// primitive visible in them.
#include <algorithm>

#include "cpu_shaders/runtime/denormals.h"
#include "cpu_shaders/runtime/simd_lanes.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

// Quads of one primitive side by side, so that interpolation broadcasts its vertex data: a counting sort. Primitive
// ids are known here, and which quads will not be filled with colour.
void TileWorker::collect_visible_quads() {
  using U4 = Simd<std::uint32_t, 4>;
  place_of_local_.assign(primitives_.size() + 1, 0);
  const std::uint32_t quads = tile_.size * tile_.size / 4;
  found_.resize(4 * quads);
  std::uint32_t count = 0;
  for (std::uint32_t quad = 0; quad < quads; ++quad) {
    const std::uint32_t* pixels = tile_.visible + 4 * quad;
    const U4 visible = U4::load(pixels);
    std::uint32_t left = (visible != U4(kNotVisible)).bits();
    if (left != 15) std::fill_n(&color_[16 * std::size_t(quad)], 16, 0.0f);
    U4 id(kNoPrimitive);
    while (left != 0) {
      const std::uint32_t local = pixels[__builtin_ctz(left)];
      const auto here = visible == U4(local);
      const std::uint32_t coverage = here.bits();
      left &= ~coverage;
      id = select(here, U4(primitives_[local].primitive), id);
      found_[count++] = {local, std::uint16_t(quad), std::uint16_t(coverage)};
      ++place_of_local_[local + 1];
    }
    id.store(&primitive_id_[4 * quad]);
  }
  for (std::size_t i = 1; i < place_of_local_.size(); ++i) place_of_local_[i] += place_of_local_[i - 1];
  sorted_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) sorted_[place_of_local_[found_[i].local]++] = found_[i];
}

void TileWorker::shade_visible() {
  {
    const FlushDenormals flush;
    draw_.kernels.cover(tile_);
  }
  collect_visible_quads();
  clock_.lap(Stage::raster);

  const bool whole_quads = draw_.module.uses_derivatives;
  for (std::size_t i = 0; i < sorted_.size();) {
    if (whole_quads)
      for (; i < sorted_.size() && !batch_.full(); ++i)
        batch_.add_quad(sorted_[i].local, sorted_[i].quad, sorted_[i].coverage);
    else
      for (; i < sorted_.size() && !batch_.full(); ++i)
        batch_.add_covered(sorted_[i].local, sorted_[i].quad, sorted_[i].coverage);
    batch_.shade(primitives_.data(), clock_);
    batch_.store(color_.data());
    batch_.clear();
    clock_.lap(Stage::store);
  }
}

}  // namespace twinshade::tiled
