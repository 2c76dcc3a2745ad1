// Shaders that discard, write gl_FragDepth or have side effects: each covered quad is shaded, in primitive order,
// before the depth test decides. Batches hold quads of several triangles; the depth test then goes through them in
// order.
#include <algorithm>

#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

void TileWorker::shade_in_order() {
  // A fragment that is hidden now stays hidden, since depth only decreases: it need not run, if nobody can tell.
  const bool early_depth_test = !draw_.module.writes_depth && !draw_.module.has_side_effects;
  std::fill_n(color_.data(), 4 * std::size_t(tile_.size) * tile_.size, 0.0f);
  batch_quads_.resize(kBatchSize / 4);
  covered_.resize(std::size_t(tile_.size) * tile_.size / 4);
  for (std::uint32_t which = 0; which < tile_.count; ++which) {
    std::uint32_t count;
    {
      const FlushDenormals flush;
      count = draw_.kernels.cover_one(tile_, which, early_depth_test, covered_.data());
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const CoveredQuad& quad = covered_[i];
      batch_quads_[batch_.count() / 4] = {quad, tile_.locals[which]};
      batch_.add_quad(tile_.locals[which], quad.quad, quad.coverage);
      if (!batch_.full()) continue;
      clock_.lap(Stage::raster);
      resolve_in_order();
    }
  }
  clock_.lap(Stage::raster);
  if (batch_.count() > 0) resolve_in_order();
  name_primitives();
}

void TileWorker::resolve_in_order() {
  batch_.shade(primitives_.data(), clock_);
  for (std::uint32_t k = 0; k < batch_.count(); ++k) {
    const BatchQuad& of = batch_quads_[k / 4];
    const std::uint32_t pixel = 4 * of.quad.quad + k % 4;
    const float depth = draw_.module.writes_depth ? batch_.frag_depth(k) : of.quad.depth[k % 4];
    if (batch_.kept(k) && depth < tile_.depth[pixel]) {
      tile_.depth[pixel] = depth;
      tile_.visible[pixel] = of.local;
    } else {
      batch_.drop(k);
    }
  }
  batch_.store(color_.data());
  batch_.clear();
  clock_.lap(Stage::store);
}

void TileWorker::name_primitives() {
  for (std::uint32_t i = 0; i < tile_.size * tile_.size; ++i)
    primitive_id_[i] = tile_.visible[i] == kNotVisible ? kNoPrimitive : primitives_[tile_.visible[i]].primitive;
}

}  // namespace twinshade::tiled
