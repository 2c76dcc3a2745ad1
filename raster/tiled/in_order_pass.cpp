// Shaders that discard, write gl_FragDepth, have side effects or read gl_HelperInvocation beside derivatives: each
// covered pixel is shaded (where the shader has derivatives, the rest of its quad, too), in primitive order, before the
// depth test decides. Batches hold pixels of
// several triangles; the depth test then goes through them in order. Where the shader does no more than discard nobody
// can tell the order, and what is nearest comes first.
#include <algorithm>

#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

void TileWorker::shade_in_order() {
  // A fragment that is hidden now stays hidden, since depth only decreases: it need not run, if nobody can tell. Nor
  // can anybody tell the order then.
  const bool early_depth_test = !draw_.module.writes_depth && !draw_.module.has_side_effects && !draw_.tells_helpers();
  const std::size_t pixels = std::size_t(tile_.size) * tile_.size;
  std::fill_n(color_.data(), 4 * pixels, 0.0f);
  blocks_.resize(pixels / 16);
  block_depths_.resize(pixels);
  const auto shade = [&](std::uint32_t which) {
    std::uint32_t count;
    {
      const FlushDenormals flush;
      count = draw_.kernels.cover_one(tile_, which, early_depth_test, blocks_.data(), block_depths_.data());
    }
    for (std::size_t taken = 0; taken < count;) {
      taken += batch_.add(&blocks_[taken], count - taken, block_depths_.data() + 16 * taken);
      if (batch_.full()) resolve_in_order();
    }
  };
  if (early_depth_test) {
    sort_groups();
    for (const TriangleGroup& group : groups_)
      for (std::uint32_t which = group.first, end = group_end(which); which < end; ++which) shade(which);
  } else {
    for (std::uint32_t which = 0; which < tile_.count; ++which) shade(which);
  }
  if (batch_.count() > 0) resolve_in_order();
  ticks_.lap(Stage::raster);
  if (draw_.options.visibility) name_primitives();
}

void TileWorker::resolve_in_order() {
  ticks_.lap(Stage::raster);
  batch_.shade(primitives_.data(), ticks_);
  batch_.test_depth(tile_.depth, tile_.visible);
  batch_.store(color_.data());
  batch_.clear();
  ticks_.lap(Stage::store);
}

void TileWorker::name_primitives() {
  const std::uint32_t* const visible = visible_.data();
  std::uint32_t* const ids = primitive_id_.data();
  for (std::uint32_t i = 0, pixels = tile_.size * tile_.size; i < pixels; ++i)
    ids[i] = visible[i] == kNotVisible ? kNoPrimitive : primitives_[visible[i]].primitive;
}

}  // namespace twinshade::tiled
